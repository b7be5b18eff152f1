// Every number of the paper that a run is compared with: value, place in the paper, and the tolerance that
// decides.
#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cinch {

/// How the value found is compared with the paper's.
enum class Rule {
  near,      ///< |here - value| <= tolerance
  at_most,   ///< here <= value
  at_least,  ///< here >= value
  limit      ///< `value` is the converged solution, not the paper's: |here - value| <= tolerance
};

/// One row of the table "paper against Cinch".
struct PaperNumber {
  std::string_view key;     ///< "capture.first_touch"
  std::string_view what;    ///< in words
  std::string_view source;  ///< "Fig. 13", "Sec. 5.3"
  Rule rule = Rule::near;
  double value = 0;
  double tolerance = 0;    ///< in the unit of the value
  std::string_view unit;   ///< empty: a plain number
  std::string_view paper;  ///< what the paper says, where it gives words and no number
  std::string_view note;   ///< how it is measured, which open inputs it hangs on
};

/// All rows, in the order of the table.
const std::vector<PaperNumber>& paper_numbers();

/// The row with this key; Error (internal) when there is none.
const PaperNumber& paper_number(std::string_view key);

/// What the paper's own run took, on a Core i7-6700HQ at 2.60 GHz with a step of 1e-6 s (Sec. 5.3).
struct PaperCost {
  double minutes = 0;
  double simulated_seconds = 0;
  std::string_view source;
};

/// Cost of the paper's run of this case; `elements` chooses among Sec. 5.1's three. Absent when not given.
std::optional<PaperCost> paper_cost(std::string_view case_name, int elements);

/// The range that a number takes over the inputs the paper leaves open (a sensitivity study), by row key.
struct OpenRange {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
  std::string note;  ///< which inputs, over which ranges
};
using Sensitivity = std::map<std::string, OpenRange, std::less<>>;

}  // namespace cinch
