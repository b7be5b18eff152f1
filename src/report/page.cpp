#include "report/page.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "output/report_file.hpp"
#include "report/assets.hpp"
#include "report/facts.hpp"
#include "report/html.hpp"

namespace cinch::page {
namespace {

using std::string;

string tag(const string& name, const string& inside, const string& look = "") {
  return "<" + name + (look.empty() ? "" : " class=\"" + look + "\"") + ">" + inside + "</" + name + ">";
}

const char* look_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
    case Verdict::converges:
      return "good";
    case Verdict::within_open_inputs:
      return "fair";
    case Verdict::missing:
      return "none";
    default:
      return "poor";
  }
}

string badge(Verdict verdict) { return tag("span", words(verdict), string("badge ") + look_of(verdict)); }

string paper_value(const PaperNumber& p) {
  const string unit(p.unit);
  if (!p.paper.empty()) return escape_markup(p.paper);
  const string tolerance = p.tolerance > 0 ? tag("span", " ± " + html::number(p.tolerance, 2), "soft") : "";
  return html::quantity(p.value, unit) + tolerance;
}

string difference(const VerdictRow& row) {
  if (!row.here) return "–";
  const bool bound = row.paper->rule == Rule::at_most || row.paper->rule == Rule::at_least;
  if (bound) {
    return (row.paper->rule == Rule::at_most ? "≤ " : "≥ ") +
           html::quantity(row.paper->value, row.paper->unit, 2) + " asked";
  }
  double off = *row.here - row.paper->value;
  if (std::abs(off) < 1e-3 * row.paper->tolerance) off = 0;
  string text = (off > 0 ? "+" : "") + html::quantity(off, row.paper->unit, 2);
  if (row.paper->value != 0 && std::abs(off) >= 1e-3 * std::abs(row.paper->value)) {
    const double share = 100 * off / std::abs(row.paper->value);
    text += tag("span", string(" (") + (share > 0 ? "+" : "") + html::number(share, 2) + " %)", "soft");
  }
  return text;
}

// Rows of the same number for further results leave out what the first of them says.
string table_row(const VerdictRow& row, bool several, const VerdictRow* above) {
  const bool again = above != nullptr && above->paper == row.paper;
  string cells =
      again ? "<td></td><td></td>"
            : tag("td", escape_markup(row.paper->what)) + tag("td", escape_markup(row.paper->source), "soft");
  if (several) cells += tag("td", escape_markup(row.result), "result");
  cells += tag("td", again ? "" : paper_value(*row.paper), row.paper->paper.empty() ? "n" : "words");
  cells += tag("td", row.here ? html::quantity(*row.here, row.paper->unit) : "–", "n");
  cells += tag("td", difference(row), "n") + tag("td", badge(row.verdict)) +
           tag("td", again && above->note == row.note ? "" : escape_markup(row.note), "note");
  return tag("tr", cells, again ? "again" : "") + "\n";
}

string fact_cell(const Fact& fact) {
  string inside = fact.text.empty() ? html::quantity(fact.value, fact.unit, 3) : escape_markup(fact.text);
  if (!fact.aside.empty()) inside += tag("span", escape_markup(fact.aside), "aside");
  return tag("td", inside);
}

// Facts of all results by name: a result that lacks one leaves its cell empty.
std::vector<string> fact_names(const std::vector<std::vector<Fact>>& all) {
  std::vector<string> names;
  for (const auto& facts : all)
    for (const Fact& fact : facts)
      if (std::find(names.begin(), names.end(), fact.what) == names.end()) names.push_back(fact.what);
  return names;
}

string sum_up(const std::vector<VerdictRow>& rows) {
  std::map<Verdict, int> count;
  for (const VerdictRow& row : rows) ++count[row.verdict];
  string text;
  for (const auto& [verdict, n] : count)
    text += (text.empty() ? "" : " ") +
            tag("span", std::to_string(n) + " " + words(verdict), string("badge ") + look_of(verdict));
  return text;
}

}  // namespace

string lead(const std::vector<Digest>& results, const std::vector<VerdictRow>& rows) {
  const Digest& d = results.front();
  string out = tag("h1", escape_markup(d.model.title.empty() ? d.model.case_name : d.model.title));
  if (!d.model.about.empty()) out += tag("p", escape_markup(d.model.about), "about");
  string status;
  for (const Digest& r : results)
    if (!r.summary || r.summary->status != "done")
      status +=
          tag("p", (results.size() > 1 ? escape_markup(r.label()) + ": " : "") + escape_markup(status_of(r)),
              "alarm");
  const string counts = rows.empty() ? "" : tag("p", "Paper against Cinch: " + sum_up(rows), "counts");
  return out + status + counts;
}

string facts(const std::vector<Digest>& results) {
  std::vector<std::vector<Fact>> all;
  for (const Digest& d : results) all.push_back(facts_of(d));
  string head = "<th></th>", rows;
  for (const Digest& d : results)
    head += tag("th", escape_markup(results.size() > 1 ? d.label() : d.model.case_name));
  for (const string& name : fact_names(all)) {
    string cells = tag("th", escape_markup(name));
    for (const auto& list : all) {
      const auto found =
          std::find_if(list.begin(), list.end(), [&](const Fact& f) { return f.what == name; });
      cells += found == list.end() ? tag("td", "–") : fact_cell(*found);
    }
    rows += tag("tr", cells) + "\n";
  }
  return "<div class=\"scroll\">" +
         tag("table", tag("thead", tag("tr", head)) + tag("tbody", rows), "facts") + "</div>\n";
}

string paper_table(const std::vector<VerdictRow>& rows, bool several) {
  if (rows.empty()) return tag("p", "The paper gives no numbers for this scene.", "soft");
  string head = tag("th", "Quantity") + tag("th", "Paper's") + (several ? tag("th", "Result") : "");
  head += tag("th", "Paper", "n") + tag("th", "Cinch", "n") + tag("th", "Difference", "n") +
          tag("th", "Verdict") + tag("th", "Sensitivity and notes");
  string body;
  for (std::size_t i = 0; i < rows.size(); ++i)
    body += table_row(rows[i], several, i > 0 ? &rows[i - 1] : nullptr);
  return "<div class=\"scroll\">" +
         tag("table", tag("thead", tag("tr", head)) + tag("tbody", body), "paper") + "</div>\n";
}

string unjudged(const std::vector<Digest>& results) {
  string out;
  for (const Digest& d : results) {
    if (d.unjudged.empty()) continue;
    string text = d.unjudged;
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    out += tag("p", escape_markup((results.size() > 1 ? d.label() + ": " + d.unjudged : text) + "."), "gap");
  }
  return out;
}

string plots(const std::vector<Plot>& list, std::size_t first) {
  string out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Plot& plot = list[i];
    const bool empty =
        std::all_of(plot.curves.begin(), plot.curves.end(), [](const Curve& c) { return c.points.empty(); });
    string inside =
        tag("h3", escape_markup(plot.title) +
                      (plot.source.empty() ? "" : tag("span", " " + escape_markup(plot.source), "soft")));
    if (empty) {
      inside +=
          tag("p", escape_markup(plot.note.empty() ? "Nothing recorded for this plot." : plot.note), "gap");
    } else {
      inside += "<div class=\"canvas\"><canvas role=\"img\" aria-label=\"" + escape_markup(plot.title) +
                "\" data-plot=\"" + std::to_string(first + i) + "\"></canvas></div>";
      if (!plot.note.empty()) inside += tag("figcaption", escape_markup(plot.note));
    }
    out += tag("figure", inside, "plot") + "\n";
  }
  return tag("div", out, "plots");
}

string stages(const Summary& summary) {
  double total = 0;
  for (const auto& stage : summary.stages) total += stage.seconds;
  if (!(total > 0)) return tag("p", "No stage timers in this result.", "soft");
  string rows;
  for (const auto& stage : summary.stages) {
    const double share = 100 * stage.seconds / total;
    rows += tag("tr",
                tag("td", escape_markup(stage.name)) + tag("td", html::quantity(stage.seconds, "s", 3), "n") +
                    tag("td", html::number(share, 3) + "\u202f%", "n") +
                    "<td class=\"bar\"><i style=\"width:" + std::to_string(static_cast<int>(share + 0.5)) +
                    "%\"></i></td>") +
            "\n";
  }
  return tag(
      "table",
      tag("thead", "<tr><th>Stage</th><th class=\"n\">Time</th><th class=\"n\">Share</th><th></th></tr>") +
          tag("tbody", rows),
      "stages");
}

string events(const Summary& summary) {
  if (summary.events.empty()) return tag("p", "No events.", "soft");
  string rows;
  for (const Event& event : summary.events) {
    string kind = event.kind;
    std::replace(kind.begin(), kind.end(), '_', ' ');
    rows += tag("tr", tag("td", html::quantity(event.time, "s", 5), "n") + tag("td", escape_markup(kind)) +
                          tag("td", escape_markup(event.name))) +
            "\n";
  }
  return tag("table",
             tag("thead", "<tr><th class=\"n\">Time</th><th>Event</th><th>Of</th></tr>") + tag("tbody", rows),
             "events");
}

string rings(const Summary& summary) {
  if (summary.ring_records.empty()) return tag("p", "No rings.", "soft");
  const auto cell = [](double value, const char* unit, bool known) {
    return tag("td", known ? html::quantity(value, unit) : "–", "n");
  };
  string rows;
  for (const RingRecord& r : summary.ring_records) {
    const bool touched = r.first_contact_time >= 0;
    rows += tag("tr", tag("td", escape_markup(r.name)) + cell(r.first_contact_time, "s", touched) +
                          cell(r.first_contact_force, "N", touched) + cell(r.peak_time, "s", touched) +
                          cell(r.peak_force, "N", touched)) +
            "\n";
  }
  return tag("table",
             tag("thead",
                 "<tr><th>Ring</th><th class=\"n\">First contact</th><th class=\"n\">… force</th>"
                 "<th class=\"n\">Peak at</th><th class=\"n\">Peak force</th></tr>") +
                 tag("tbody", rows),
             "rings");
}

string reproduce(const std::vector<Digest>& results) {
  string out;
  for (const Digest& d : results) {
    const string name = d.model.case_name.empty() ? "case" : d.model.case_name;
    const string commands = "cinch run " + name + ".toml --out results/" + name + " --threads " +
                            std::to_string(d.model.threads) + "\ncinch report results/" + name;
    out += tag("p",
               "Save the resolved case below as " + tag("code", escape_markup(name + ".toml")) + ", then:") +
           tag("pre", escape_markup(commands)) + "<details><summary>Resolved case" +
           (results.size() > 1 ? " of " + escape_markup(d.label()) : "") + "</summary>" +
           tag("pre", escape_markup(d.model.case_toml)) + "</details>\n";
  }
  return out;
}

string whole(const string& title, const string& body, const string& plots_json, const string& view_json) {
  string out = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" + string(kPageMark) +
               "\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
               "<link rel=\"icon\" href=\"data:,\">\n<title>" +
               escape_markup(title) + "</title>\n<style>\n";
  out += assets::page_css();
  out += "</style>\n</head>\n<body>\n<main>\n" + body + "</main>\n";
  out += "<script type=\"application/json\" id=\"plots\">" + html::script_safe(plots_json) + "</script>\n";
  if (!view_json.empty()) {
    out +=
        "<script type=\"application/json\" id=\"net-view\">" + html::script_safe(view_json) + "</script>\n";
    out += "<script>" + html::script_safe(assets::three_js()) + "</script>\n";
  }
  out += "<script>" + html::script_safe(assets::chart_js()) + "</script>\n";
  out += "<script>" + html::script_safe(assets::page_js()) + "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace cinch::page
