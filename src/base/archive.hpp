// Named lists of numbers and texts that something is saved to or restored from. The same code does both: it
// names its fields in turn, and the archive reads or writes them.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace cinch {

/// Every function throws FileError, which names the file and the field, when the archive refuses: no such
/// field, another length, a number out of its range.
class Archive {
 public:
  virtual ~Archive() = default;
  virtual bool restoring() const = 0;

  /// As many numbers as were saved.
  virtual void values(const std::string& name, std::span<double> numbers) = 0;
  virtual void values(const std::string& name, std::span<std::int64_t> numbers) = 0;
  virtual void texts(const std::string& name, std::vector<std::string>& list) = 0;
  /// `now` while saving; of the list that was saved while restoring.
  virtual std::size_t length(const std::string& name, std::size_t now) = 0;
  /// Whether there is such a field: earlier versions saved fewer. While saving always.
  virtual bool holds(const std::string& name) const = 0;
  /// The file's name.
  virtual std::string place() const = 0;

  /// Throws FileError: "error: FILE: NAME WHY".
  [[noreturn]] void refuse(const std::string& name, const std::string& why) const;

  void value(const std::string& name, double& number) { values(name, std::span(&number, 1)); }
  /// A whole number or flag, from `low` to `high`.
  template <class Whole>
  void whole(const std::string& name, Whole& number, std::int64_t low, std::int64_t high) {
    std::int64_t wide = static_cast<std::int64_t>(number);
    values(name, std::span(&wide, 1));
    number = static_cast<Whole>(within(name, wide, low, high));
  }
  void flag(const std::string& name, bool& is) { whole(name, is, 0, 1); }
  void text(const std::string& name, std::string& text);

  /// A list of any length.
  template <class List>
  void list(const std::string& name, List& numbers) {
    numbers.resize(length(name, numbers.size()));
    values(name, std::span(numbers));
  }
  /// Whole numbers, each from `low` to `high`.
  template <class Whole>
  void wholes(const std::string& name, std::vector<Whole>& numbers, std::int64_t low, std::int64_t high) {
    std::vector<std::int64_t> wide(numbers.begin(), numbers.end());
    list(name, wide);
    numbers.clear();
    for (const std::int64_t number : wide)
      numbers.push_back(static_cast<Whole>(within(name, number, low, high)));
  }

  /// One member of each of the records, as a list: numbers or arrays of numbers.
  template <class Record, class Member>
  void column(const std::string& name, std::vector<Record>& records, Member Record::*member) {
    using Number = std::remove_all_extents_t<Member>;
    constexpr std::size_t width = sizeof(Member) / sizeof(Number);
    std::vector<Number> numbers;
    for (const Record& record : records) {
      const auto* const first = reinterpret_cast<const Number*>(&(record.*member));
      numbers.insert(numbers.end(), first, first + width);
    }
    values(name, std::span(numbers));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      reinterpret_cast<Number*>(&(records[i / width].*member))[i % width] = numbers[i];
  }
  /// A whole number of each of the records, from `low` to `high`.
  template <class Record, class Whole>
  void column(const std::string& name, std::vector<Record>& records, Whole Record::*member, std::int64_t low,
              std::int64_t high) {
    std::vector<std::int64_t> numbers;
    for (const Record& record : records) numbers.push_back(record.*member);
    values(name, std::span(numbers));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      records[i].*member = static_cast<Whole>(within(name, numbers[i], low, high));
  }

 protected:
  std::int64_t within(const std::string& name, std::int64_t number, std::int64_t low,
                      std::int64_t high) const;
};

}  // namespace cinch
