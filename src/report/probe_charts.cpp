// Charts of a case's own probes.
#include <algorithm>
#include <cctype>
#include <map>

#include "report/charts.hpp"

namespace cinch {
namespace {

constexpr std::size_t kColours = 8;  // in page.css

/// All columns of one probe.
struct Probed {
  std::string name, quantity, of, unit;
  std::vector<const ProbeSeries*> columns;
};

// "ball.x" is of the probe "ball".
std::string probe_of(const std::string& column) {
  for (const char* part : {".x", ".y", ".z", ".magnitude"})
    if (column.ends_with(part)) return column.substr(0, column.rfind('.'));
  return column;
}

std::vector<Probed> probes_of(const Digest& d) {
  std::vector<Probed> all;
  for (const ProbeSeries& series : d.probes) {
    const std::string name = probe_of(series.column.name);
    if (all.empty() || all.back().name != name)
      all.push_back({name, probed_quantity(series.column), series.column.of, series.column.unit, {}});
    all.back().columns.push_back(&series);
  }
  return all;
}

bool is_shown(const Probed& probe, const std::vector<Plot>& plots) {
  const std::string key = probe_key(probe.quantity, probe.of);
  return std::any_of(plots.begin(), plots.end(), [&](const Plot& plot) {
    return std::find(plot.shows.begin(), plot.shows.end(), key) != plot.shows.end();
  });
}

// "mouth_area" to "mouth area".
std::string in_words(std::string quantity) {
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  return quantity;
}

std::string in_print(std::string unit) {
  if (unit.ends_with("^2")) unit.replace(unit.size() - 2, 2, "²");
  return unit;
}

Plot empty_chart(const Probed& probe, const std::vector<Mark>& marks) {
  Plot plot;
  plot.title = in_words(probe.quantity) + ":";
  plot.title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title.front())));
  plot.x = "t, s";
  plot.y = in_words(probe.quantity) + ", " + in_print(probe.unit);
  plot.marks = marks;
  plot.from_zero = probe.columns.size() == 1;  // a size, no component
  return plot;
}

void draw(const Probed& probe, Plot& plot) {
  plot.title += (plot.curves.empty() ? " " : ", ") + probe.name;
  if (!probe.of.empty()) plot.note += (plot.note.empty() ? "" : "; ") + probe.name + ": " + probe.of;
  for (const ProbeSeries* series : probe.columns)
    plot.curves.push_back(
        {series->column.name, series->values, "line", static_cast<int>(plot.curves.size())});
}

}  // namespace

std::vector<Plot> probe_plots(const Digest& d, const std::vector<Plot>& others) {
  const std::vector<Mark> marks = event_marks(d);
  std::vector<Probed> probes = probes_of(d);
  std::erase_if(probes, [&](const Probed& probe) { return is_shown(probe, others); });
  std::vector<Plot> plots;
  std::vector<std::string> done;
  for (const Probed& first : probes) {
    if (std::find(done.begin(), done.end(), first.quantity) != done.end()) continue;
    done.push_back(first.quantity);
    plots.push_back(empty_chart(first, marks));
    for (const Probed& probe : probes) {
      if (probe.quantity != first.quantity) continue;
      if (plots.back().curves.size() + probe.columns.size() > kColours)
        plots.push_back(empty_chart(first, marks));
      draw(probe, plots.back());
    }
  }
  return plots;
}

std::size_t leave_out(std::vector<Plot>& plots, std::size_t most) {
  std::size_t count = 0;
  for (; plots.size() > most; ++count) {
    std::map<std::string, int> charts;
    for (const Plot& plot : plots) ++charts[plot.y];
    const auto longest =
        std::max_element(charts.begin(), charts.end(), [](auto& a, auto& b) { return a.second < b.second; });
    const auto last = std::find_if(plots.rbegin(), plots.rend(),
                                   [&](const Plot& plot) { return plot.y == longest->first; });
    plots.erase(std::next(last).base());
  }
  return count;
}

}  // namespace cinch
