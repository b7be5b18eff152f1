// The sections of the report page as HTML text.
#pragma once
#include <string>
#include <vector>

#include "report/charts.hpp"
#include "report/digest.hpp"
#include "report/verdict.hpp"

namespace cinch::page {

/// Head line: how the run ended and how many of the paper's numbers came out.
std::string lead(const std::vector<Digest>& results, const std::vector<VerdictRow>& rows);
/// Verdict box: one column for each result.
std::string facts(const std::vector<Digest>& results);
/// Table "paper against Cinch"; a sentence where the paper gives nothing for the case.
std::string paper_table(const std::vector<VerdictRow>& rows, bool several);
/// A line for each result that is not compared with the paper though it is much like one of its scenes.
std::string unjudged(const std::vector<Digest>& results);
/// Figures for plots; their data stand in the page's script, numbered from `first`.
std::string plots(const std::vector<Plot>& list, std::size_t first);
std::string stages(const Summary& summary);
std::string events(const Summary& summary);
std::string rings(const Summary& summary);
/// Commands, versions and the resolved case of each result.
std::string reproduce(const std::vector<Digest>& results);
/// Head, style, libraries, body, data and script put together.
std::string whole(const std::string& title, const std::string& body, const std::string& plots_json,
                  const std::string& view_json);

}  // namespace cinch::page
