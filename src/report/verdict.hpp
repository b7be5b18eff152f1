// The table "paper against Cinch": measures each of the paper's numbers in the results and judges it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/digest.hpp"
#include "report/paper_numbers.hpp"

namespace cinch {

enum class Verdict {
  reproduced,
  within_open_inputs,  ///< the paper's value lies in the range found over the inputs that it leaves open
  not_reproduced,
  converges,  ///< near the converged solution, or nearer with each finer result
  not_converged,
  missing  ///< the results at hand do not say
};

const char* words(Verdict verdict);

struct VerdictRow {
  const PaperNumber* paper = nullptr;
  std::optional<double> here;
  Verdict verdict = Verdict::missing;
  std::string result;  ///< label of the result it was measured in, where there are several
  std::string note;    ///< how it was measured, what is missing, what it is sensitive to
};

/// The verdict on one number, without looking at open inputs when `range` is null.
Verdict judge(const PaperNumber& paper, double here, const OpenRange* range = nullptr);

/// All rows that apply to the case of the first result; results of other cases are left out. Runs of `again`
/// repeat captures among the results, each begun a little otherwise: rows are medians then.
std::vector<VerdictRow> compare_with_paper(const std::vector<Digest>& results,
                                           const Sensitivity& sensitivity = {},
                                           const std::vector<Digest>& again = {});

}  // namespace cinch
