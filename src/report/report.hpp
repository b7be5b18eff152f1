// What `cinch report` makes of finished (or broken off) runs: the paper's numbers beside ours, its figures,
// pictures.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <vector>

#include "output/result_reader.hpp"
#include "report/digest.hpp"
#include "report/paper_numbers.hpp"

namespace cinch {

/// Writes one self-contained HTML page about all `results` (first one first): verdict, paper against Cinch,
/// plots, pictures, a turnable net. It loads nothing from a network or from beside it. Throws FileError when
/// it cannot be written, Error (usage) when there is no result. `open_inputs`: the range of each number over
/// the inputs that the paper leaves open (range_over); without it no number is "within the open inputs".
/// `again`: runs that repeat captures among the results (repeats.hpp).
void write_report(const std::vector<Result>& results, const std::filesystem::path& html_file,
                  const Sensitivity& open_inputs = {}, const std::vector<Digest>& again = {});

/// The same table "paper against Cinch" as Markdown, for a README. Errors as write_report.
void write_paper_table(const std::vector<Result>& results, const std::filesystem::path& markdown_file,
                       const Sensitivity& open_inputs = {}, const std::vector<Digest>& again = {});

/// The verdict and the paper's table of one result as plain text, for the terminal; `again` as for a page.
void print_verdict(const Result& result, std::ostream& out, const std::vector<Digest>& again = {});

}  // namespace cinch
