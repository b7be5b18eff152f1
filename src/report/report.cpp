#include "report/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <ostream>

#include "base/error.hpp"
#include "output/text_file.hpp"
#include "report/facts.hpp"
#include "report/html.hpp"
#include "report/measure.hpp"
#include "report/net_picture.hpp"
#include "report/net_view.hpp"
#include "report/page.hpp"

namespace cinch {
namespace {

using std::string;

// The times of the paper's figures, s; six evenly spaced ones for cases of our own.
std::vector<double> picture_times(const Digest& d) {
  std::vector<double> times;
  switch (d.paper_case) {
    case PaperCase::capture:
      return {0, 0.5, 1.0, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0};
    case PaperCase::edge_closure:
      return {0, 0.1, 0.2, 0.3, 0.4, 0.5};
    case PaperCase::ring_pull:
      return {0, 0.2, 0.4, 0.6, 0.8, 1.0};
    default:
      for (int i = 0; i < 6; ++i) times.push_back(d.end_time() * i / 5);
      return times;
  }
}

int nearest_frame(const std::vector<double>& times, double time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return 0;
  const auto i = static_cast<int>(after - times.begin());
  if (after == times.end() || time - *(after - 1) < *after - time) return i - 1;
  return i;
}

ViewHints hints_of(const Digest& d) {
  ViewHints hints{d.gravity, Vec3::Zero(), d.paper_case == PaperCase::ring_pull};
  if (const auto pair = measure::left_and_right(d)) {
    const auto start = [&](int mass) { return d.mass_position[static_cast<std::size_t>(mass)].v.front(); };
    hints.rightwards = start((*pair)[1]) - start((*pair)[0]);
  }
  return hints;
}

string time_label(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "t = %.4g s", time);
  return text;
}

// Frames nearest to the wanted times; times that the run does not reach, or has no frame near, are named in
// `missing`.
std::vector<Frame> frames_at(const Result& result, const std::vector<double>& wanted, string& missing) {
  const auto& times = result.frame_times();
  const double spacing =
      times.size() > 1 ? (times.back() - times.front()) / static_cast<double>(times.size() - 1) : 0;
  std::vector<Frame> frames;
  for (const double time : wanted) {
    const int k = nearest_frame(times, time);
    if (std::abs(times[static_cast<std::size_t>(k)] - time) > 0.51 * spacing + 1e-6) {
      missing += (missing.empty() ? "" : ", ") + time_label(time).substr(4);
    } else {
      frames.push_back(result.frame(k));
    }
  }
  return frames;
}

string line_sample(const string& look, const string& text) {
  return "<span><svg width=\"26\" height=\"10\"><path class=\"" + look + "\" d=\"M1 5H25\"/></svg>" + text +
         "</span>";
}

string dot_sample(const string& look, const string& text) {
  return "<span><svg width=\"12\" height=\"12\"><circle class=\"" + look +
         "\" cx=\"6\" cy=\"6\" r=\"5\"/></svg>" + text + "</span>";
}

// One entry for each kind of part that the scene has; the first kind of line shows the four levels of
// tension.
string legend(const ResultModel& model, double reference) {
  const string tenth = html::quantity(reference / 10, "N", 2), full = html::quantity(reference, "N", 2);
  string out;
  const auto has = [&](const char* kind) {
    return std::any_of(model.parts.begin(), model.parts.end(),
                       [&](const auto& part) { return part.kind == kind; });
  };
  for (const auto& [kind, look, name] :
       {std::array{"net", "n", "net"}, {"thread", "c", "thread"}, {"mechanism", "t", "towing thread"}}) {
    if (!has(kind)) continue;
    const bool levels = out.empty();
    out += line_sample(string(look) + (levels ? "0" : "2"), name + string(levels ? ", slack" : ""));
    if (!levels) continue;
    out += line_sample(string(look) + "1", "below " + tenth) + line_sample(string(look) + "2", "to " + full) +
           line_sample(string(look) + "3", "above");
  }
  if (has("mechanism")) out += dot_sample("ml", "mechanism, launcher") + dot_sample("ms", "split mass");
  if (!has("mechanism") && !model.masses.empty()) out += dot_sample("mo", "mass");
  return "<p class=\"legend\">" + out + "</p>\n";
}

string pictures(const PictureSet& set, const std::vector<Frame>& frames, const string& prefix) {
  string out;
  for (std::size_t i = 0; i < frames.size(); ++i)
    out += "<figure>" + net_picture(set, frames[i], time_label(frames[i].time), prefix + std::to_string(i)) +
           "</figure>";
  return "<div class=\"pictures\">" + out + "</div>" + legend(*set.model, set.tension_reference);
}

string gap(const string& text) { return "<p class=\"gap\">" + escape_markup(text) + "</p>\n"; }

string picture_section(const Result& result, const Digest& d) {
  string missing;
  const auto frames =
      result.frames() > 0 ? frames_at(result, picture_times(d), missing) : std::vector<Frame>{};
  string out = "<section><h2>The net at the paper's times</h2>\n";
  if (d.paper_case == PaperCase::none) out = "<section><h2>Pictures</h2>\n";
  if (!frames.empty()) out += pictures(picture_set(d.model, frames, hints_of(d)), frames, "ball-");
  if (!missing.empty())
    out += gap("No frame at " + missing + ": the run ends at " + time_label(d.end_time()).substr(4) + ".");
  if (frames.empty()) out += gap("No frames in this result.");
  return out + "</section>\n";
}

std::vector<std::size_t> by_closing_time(const std::vector<Digest>& digests) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < digests.size(); ++i)
    if (digests[i].paper_case == PaperCase::capture && digests[i].model.closing_time) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return *digests[a].model.closing_time < *digests[b].model.closing_time;
  });
  return order;
}

string closing_time_row(const Digest& d) {
  const double closing = *d.model.closing_time;
  const auto closed = measure::closed_after(d), enclosed = measure::enclosed(d);
  string z = "–";
  if (const auto pair = measure::split_masses(d))
    if (const auto place = measure::mass_at(d, (*pair)[0], 2, closing + 0.4).value)
      z = html::quantity(*place, "m");
  const auto cell = [](const string& text) { return "<td class=\"n\">" + text + "</td>"; };
  return "<tr>" + cell(html::quantity(closing, "s")) +
         cell(closed.value ? html::quantity(*closed.value + closing, "s") : "–") +
         cell(closed.value ? html::quantity(*closed.value, "s") : "–") + cell(z) + "<td>" +
         (!enclosed.value       ? "–"
          : *enclosed.value > 0 ? "yes"
                                : "no") +
         "</td></tr>\n";
}

// Fig. 14: captures that close at different times, 0.4 s after each, all at the scale of the widest.
string closing_times_section(const std::vector<Result>& results, const std::vector<Digest>& digests) {
  struct Card {
    const Digest* of;
    Frame frame;
    PictureSet set;
  };
  std::vector<Card> cards;
  string rows, missing, pictures;
  for (const std::size_t i : by_closing_time(digests)) {
    rows += closing_time_row(digests[i]);
    const auto frames = frames_at(results[i], {*digests[i].model.closing_time + 0.4}, missing);
    if (frames.empty()) continue;
    cards.push_back({&digests[i], frames[0], picture_set(digests[i].model, frames, hints_of(digests[i]))});
  }
  const auto widest = std::min_element(cards.begin(), cards.end(), [](const Card& a, const Card& b) {
    return a.set.pixels_per_metre < b.set.pixels_per_metre;
  });
  if (widest != cards.end()) {
    const PictureSet view = widest->set;
    for (Card& card : cards) {
      card.set.take_view_of(view);
      const string label = card.of->label() + ", " + time_label(card.frame.time);
      pictures += "<figure>" +
                  net_picture(card.set, card.frame, label, "late-" + std::to_string(&card - cards.data())) +
                  "</figure>";
    }
  }
  return "<section><h2>Closing times <span class=\"soft\">Fig. 14</span></h2>\n<div class=\"pictures\">" +
         pictures + "</div>\n" + (missing.empty() ? "" : gap("No frame at " + missing + ".")) +
         "<table><thead><tr><th class=\"n\">Closing time</th><th class=\"n\">Mouth closed</th><th "
         "class=\"n\">… later</th>"
         "<th class=\"n\">Z of A1 0.4 s later</th><th>Enclosed</th></tr></thead><tbody>" +
         rows + "</tbody></table></section>\n";
}

bool several_closing_times(const std::vector<Digest>& digests) {
  const auto order = by_closing_time(digests);
  return order.size() > 1 &&
         *digests[order.front()].model.closing_time < *digests[order.back()].model.closing_time;
}

string view_section() {
  return "<section><h2>Turn the net</h2>\n<div id=\"view\"><canvas tabindex=\"0\" aria-label=\"Turnable view "
         "of the net\">"
         "</canvas><p class=\"gap\" hidden></p></div>\n<div id=\"view-controls\"><button type=\"button\" "
         "id=\"view-play\">Play</button>"
         "<input type=\"range\" id=\"view-time\" min=\"0\" value=\"0\" step=\"1\" "
         "aria-label=\"time\"><output id=\"view-label\"></output>"
         "</div>\n<p class=\"soft small\">Drag to turn, wheel or pinch to come nearer, right button or two "
         "fingers to move; "
         "double click to start over.</p></section>\n";
}

// Charts of the first result's own probes.
constexpr std::size_t kMostProbeCharts = 24;

string probe_section(const std::vector<Plot>& charts, std::size_t left_out, const string& label,
                     std::size_t first) {
  if (charts.empty()) return "";
  string out = "<section><h2>Probes" +
               (label.empty() ? "" : " <span class=\"soft\">of " + escape_markup(label) + "</span>") +
               "</h2>\n" + page::plots(charts, first);
  if (left_out > 0)
    out += gap(std::to_string(left_out) +
               " more charts would make this page slow; the result holds all probes.");
  return out + "</section>\n";
}

string record_section(const Digest& d) {
  if (!d.summary) return "";
  return "<section><h2>Record</h2>\n<div class=\"columns\"><div><h3>Rings</h3>" + page::rings(*d.summary) +
         "</div><div><h3>Events</h3><div class=\"tall\">" + page::events(*d.summary) +
         "</div></div><div><h3>Stages</h3>" + page::stages(*d.summary) + "</div></div></section>\n";
}

}  // namespace

void write_report(const std::vector<Result>& results, const std::filesystem::path& html_file,
                  const Sensitivity& open_inputs, const std::vector<Digest>& again) {
  if (results.empty()) throw Error(ExitCode::usage, "report: no result given");
  const std::vector<Digest> digests = digest_all(results);
  const auto rows = compare_with_paper(digests, open_inputs, again);
  const Digest& d = digests.front();
  const auto figures = figure_plots(digests), energy = energy_plots(d);
  auto probes = probe_plots(d, figures);
  const std::size_t left_out = leave_out(probes, kMostProbeCharts);

  string body = page::lead(digests, rows);
  body += "<section><h2>Verdict</h2>\n" + page::facts(digests) + "</section>\n";
  body += "<section><h2>Paper against Cinch</h2>\n" + page::paper_table(rows, digests.size() > 1) +
          page::unjudged(digests) + "</section>\n";
  if (!figures.empty()) body += "<section><h2>Figures</h2>\n" + page::plots(figures, 0) + "</section>\n";
  body += probe_section(probes, left_out, digests.size() > 1 ? d.label() : "", figures.size());
  body += picture_section(results.front(), d);
  if (several_closing_times(digests)) body += closing_times_section(results, digests);
  string view;
  if (results.front().frames() > 0) {
    const Frame first = results.front().frame(0), last = results.front().frame(results.front().frames() - 1);
    view = net_view_json(results.front(), d.model, choose_camera(d.model, first, last, hints_of(d)));
    body += view.empty() ? gap("The net is too large for the turnable view of this page.") : view_section();
  }
  body += "<section><h2>Energy and tension</h2>\n" + page::plots(energy, figures.size() + probes.size()) +
          "</section>\n";
  body += record_section(d) + "<section><h2>How to reproduce this</h2>\n" + page::reproduce(digests) +
          "</section>\n";

  auto plots = figures;
  for (const auto& more : {probes, energy}) plots.insert(plots.end(), more.begin(), more.end());
  replace_text_file(html_file, page::whole(d.model.case_name + " - Cinch", body, plots_json(plots), view));
}

void print_verdict(const Result& result, std::ostream& out, const std::vector<Digest>& again) {
  const std::vector<Digest> digests = [&] {
    std::vector<Digest> one;
    one.push_back(digest(result));
    return one;
  }();
  char text[256];
  for (const Fact& fact : facts_of(digests.front())) {
    const string value = fact.text.empty() ? html::plain(fact.value, fact.unit, 3) : fact.text;
    std::snprintf(text, sizeof text, "%-26s", fact.what.c_str());
    out << text << value << (fact.aside.empty() ? "" : "  (" + fact.aside + ")") << '\n';
  }
  const auto rows = compare_with_paper(digests, {}, again);
  if (!rows.empty()) out << "\npaper against Cinch\n";
  if (!digests.front().unjudged.empty()) out << "\n" << digests.front().unjudged << "\n";
  for (const VerdictRow& row : rows) {
    const PaperNumber& p = *row.paper;
    const string paper = p.paper.empty() ? html::plain(p.value, p.unit) : string(p.paper);
    std::snprintf(text, sizeof text, "  %-22s ", words(row.verdict));
    out << text << p.what << ": paper " << paper << ", here "
        << (row.here ? html::plain(*row.here, p.unit) : "-") << "  [" << p.source
        << (row.note.empty() ? "" : "; " + row.note) << "]\n";
  }
}

}  // namespace cinch
