#include "report/open_inputs.hpp"

#include <filesystem>

#include "report/html.hpp"
#include "report/verdict.hpp"

namespace cinch {
namespace {

// The ends of one number's range and who reached them.
struct Ends {
  double low = 0, high = 0;
  std::string low_at, high_at;

  Ends(double value, const std::string& variant)
      : low(value), high(value), low_at(variant), high_at(variant) {}
  void take(double value, const std::string& variant) {
    if (value < low) low = value, low_at = variant;
    if (value > high) high = value, high_at = variant;
  }
};

std::string note(const Ends& ends, std::string_view unit) {
  return "over the open inputs " + html::plain(ends.low, unit) + " (" + ends.low_at + ") to " +
         html::plain(ends.high, unit) + " (" + ends.high_at + ")";
}

}  // namespace

Sensitivity range_over(const std::vector<Digest>& variants) {
  std::map<std::string, Ends, std::less<>> ends;
  for (const Digest& variant : variants) {
    const std::string name = std::filesystem::path(variant.file).parent_path().filename().string();
    for (const VerdictRow& row : compare_with_paper({variant})) {
      if (!row.here) continue;
      const auto [at, fresh] = ends.try_emplace(std::string(row.paper->key), *row.here, name);
      if (!fresh) at->second.take(*row.here, name);
    }
  }
  Sensitivity ranges;
  for (const auto& [key, found] : ends)
    ranges[key] = {found.low, found.high, note(found, paper_number(key).unit)};
  return ranges;
}

}  // namespace cinch
