// An archive that keeps everything in memory, so that tests can look at what was saved and spoil it.
#pragma once
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "base/archive.hpp"

namespace cinch::test {

using Entry = std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>>;
using Entries = std::map<std::string, Entry>;

class MemoryArchive : public Archive {
 public:
  MemoryArchive() : restoring_(false) {}
  explicit MemoryArchive(Entries saved) : entries(std::move(saved)), restoring_(true) {}

  bool restoring() const override { return restoring_; }
  std::string place() const override { return "memory"; }
  void values(const std::string& name, std::span<double> numbers) override { exchange(name, numbers); }
  void values(const std::string& name, std::span<std::int64_t> numbers) override { exchange(name, numbers); }
  void texts(const std::string& name, std::vector<std::string>& list) override {
    if (restoring_) list = find<std::string>(name);
    else entries[name] = list;
  }
  std::size_t length(const std::string& name, std::size_t now) override {
    if (!restoring_) return now;
    if (!holds(name)) refuse(name, "is missing");
    return std::visit([](const auto& list) { return list.size(); }, entries.at(name));
  }
  bool holds(const std::string& name) const override { return !restoring_ || entries.contains(name); }

  Entries entries;

 private:
  template <class Value>
  const std::vector<Value>& find(const std::string& name) {
    length(name, 0);
    const auto* const list = std::get_if<std::vector<Value>>(&entries.at(name));
    if (list == nullptr) refuse(name, "is of another type");
    return *list;
  }
  template <class Number>
  void exchange(const std::string& name, std::span<Number> numbers) {
    if (!restoring_) {
      entries[name] = std::vector<Number>(numbers.begin(), numbers.end());
      return;
    }
    const std::vector<Number>& list = find<Number>(name);
    if (list.size() != numbers.size()) refuse(name, "has another length");
    std::copy(list.begin(), list.end(), numbers.begin());
  }

  bool restoring_;
};

}  // namespace cinch::test
