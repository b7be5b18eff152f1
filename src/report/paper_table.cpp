// The table "paper against Cinch" as Markdown.
#include "base/error.hpp"
#include "output/report_file.hpp"
#include "output/text_file.hpp"
#include "report/html.hpp"
#include "report/report.hpp"
#include "report/verdict.hpp"

namespace cinch {
namespace {

// A bar would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.insert(at, "\\");
  return " " + text + " |";
}

std::string row_text(const VerdictRow& row) {
  const PaperNumber& p = *row.paper;
  std::string what(p.what);
  if (!row.result.empty()) what += " (" + row.result + ")";
  return "|" + cell(what) + cell(std::string(p.source)) +
         cell(p.paper.empty() ? html::plain(p.value, p.unit) : std::string(p.paper)) +
         cell(row.here ? html::plain(*row.here, p.unit) : "-") + cell(words(row.verdict)) + cell(row.note) +
         "\n";
}

}  // namespace

void write_paper_table(const std::vector<Result>& results, const std::filesystem::path& markdown_file,
                       const Sensitivity& open_inputs, const std::vector<Digest>& again) {
  if (results.empty()) throw Error(ExitCode::usage, "report: no result given");
  std::string text =
      "| " + results.front().model().case_name + " " + kTableMark + "\n|---|---|---|---|---|---|\n";
  const std::vector<Digest> digests = digest_all(results);
  for (const VerdictRow& row : compare_with_paper(digests, open_inputs, again)) text += row_text(row);
  for (const Digest& d : digests)
    if (!d.unjudged.empty()) text += "|" + cell(d.label() + ": " + d.unjudged) + " | | | | |\n";
  replace_text_file(markdown_file, text + "\n");
}

}  // namespace cinch
