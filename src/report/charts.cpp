#include "report/charts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "report/measure.hpp"
#include "report/paper_numbers.hpp"

namespace cinch {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::vector<const Digest*> of_case(const std::vector<Digest>& results) {
  std::vector<const Digest*> same;
  for (const Digest& d : results)
    if (d.paper_case == results.front().paper_case) same.push_back(&d);
  return same;
}

Series end_to_end(const Series& x, const Series& y) { return {x.v, y.v}; }

// One curve of `pick` for each result that has it.
template <class Pick>
std::vector<Curve> curve_each(const std::vector<const Digest*>& results, Pick pick) {
  std::vector<Curve> curves;
  int colour = 0;
  for (const Digest* d : results) {
    Series series = pick(*d);
    if (!series.empty()) curves.push_back({d->label(), std::move(series), "line", colour});
    ++colour;
  }
  return curves;
}

// The probes whose curve a plot shows.
void show(Plot& plot, std::initializer_list<const char*> quantities, const std::string& of) {
  for (const char* quantity : quantities) plot.shows.push_back(probe_key(quantity, of));
}

// The paper's Figs. 12 and 13 begin shortly before the closing time.
std::optional<double> before_closing(const Digest& d) {
  if (!d.model.closing_time) return std::nullopt;
  return std::max(0.0, *d.model.closing_time - 0.1);
}

Plot force_against_elements(const std::vector<const Digest*>& results) {
  Plot plot{"Largest contact force on the ring against the number of elements",
            "Fig. 9",
            "elements of the thread",
            "force, N",
            {},
            {},
            "",
            false,
            true};
  std::vector<std::pair<double, double>> points;
  for (const Digest* d : results)
    if (const auto peak = measure::peak_ring_force(*d).value)
      points.emplace_back(d->thread_elements(), *peak);
  std::sort(points.begin(), points.end());
  Curve here{"Cinch", {}, points.size() > 1 ? "line" : "points", 0},
      paper{"paper, read off its plot", {}, "reference", 1};
  for (const auto& [n, force] : points) here.points.t.push_back(n), here.points.v.push_back(force);
  for (const int n : {50, 100, 200, 300}) {
    paper.points.t.push_back(n);
    paper.points.v.push_back(paper_number("ring_pull.force_" + std::to_string(n)).value);
  }
  if (!here.points.empty()) plot.curves = {here, paper};
  if (points.size() < 2) plot.note = "Give results of several element numbers for a curve.";
  return plot;
}

std::vector<Plot> ring_pull_plots(const std::vector<const Digest*>& results) {
  const auto ring_y = [](const Digest& d) {
    return d.ring_position.empty() ? Series{} : d.ring_position[0].component(1);
  };
  const auto path = [](const Digest& d) {
    return d.mass_position.empty()
               ? Series{}
               : end_to_end(d.mass_position[0].component(1), d.mass_position[0].component(2));
  };
  const auto force = [](const Digest& d) { return d.ring_force.empty() ? Series{} : d.ring_force[0].norm(); };
  Plot ball{"Path of the ball", "Fig. 7", "Y, m", "Z, m", curve_each(results, path), {}, "", true, false};
  if (!ball.curves.empty())
    ball.curves.push_back(
        {"limit at 1.0 s",
         {{paper_number("ring_pull.ball_y").value}, {paper_number("ring_pull.ball_z").value}},
         "reference",
         4});
  Plot ring{"Displacement of the ring",
            "Fig. 8",
            "t, s",
            "ring Y, m",
            curve_each(results, ring_y),
            {},
            "",
            false,
            false};
  Plot contact{
      "Contact force on the ring", "", "t, s", "force, N", curve_each(results, force), {}, "", false, true};
  const ResultModel& model = results.front()->model;
  for (const auto& mass : model.masses) show(ball, {"position", "displacement"}, mass.name);
  for (const auto& each : model.rings) {
    show(ring, {"position", "displacement"}, "ring." + each.name);
    show(contact, {"force"}, "ring." + each.name);
  }
  return {ring, force_against_elements(results), ball, contact};
}

std::vector<Plot> edge_closure_plots(const std::vector<const Digest*>& results) {
  const Digest& d = *results.front();
  Plot heights{"Heights of the two masses", "Fig. 10", "t, s", "height, m", {}, {}, "", false, false};
  if (const auto pair = measure::left_and_right(d); pair && d.gravity) {
    const Vec3 up = -d.gravity->normalized();
    for (std::size_t side = 0; side < 2; ++side) {
      const VectorSeries& path = d.mass_position[at((*pair)[side])];
      Curve curve{side == 0 ? "left mass" : "right mass", {path.t, {}}, "line", static_cast<int>(side)};
      for (const Vec3& p : path.v) curve.points.v.push_back(up.dot(p));
      heights.curves.push_back(curve);
      show(heights, {"position", "displacement"}, d.model.masses[at((*pair)[side])].name);
    }
  } else {
    heights.note = "The result names no two masses, or its case has no gravity.";
  }
  Plot spread{"Greatest distance between ring centres",
              "Fig. 10",
              "t, s",
              "distance, m",
              curve_each(results, [](const Digest& r) { return r.mouth_spread; }),
              {},
              "",
              false,
              true};
  if (!spread.curves.empty()) {
    const double level = paper_number("edge_closure.bunched").value;
    spread.curves.push_back({"bunched", {{0, d.end_time()}, {level, level}}, "dash", 4});
  }
  show(spread, {"mouth_spread"}, "");
  Plot force{"Contact force on the rings", "", "t, s", "force, N", {}, {}, "", false, true};
  for (std::size_t r = 0; r < d.ring_force.size(); ++r) {
    force.curves.push_back(
        {"ring " + d.model.rings[r].name, d.ring_force[r].norm(), "line", static_cast<int>(r)});
    show(force, {"force"}, "ring." + d.model.rings[r].name);
  }
  return {heights, spread, force};
}

Plot velocity_plot(const Digest& d, int axis) {
  const char name = "XYZ"[axis];
  Plot plot{std::string(1, name) + " velocities of split masses A and B of mechanism 1",
            "Fig. 12",
            "t, s",
            std::string("v") + name + ", m/s",
            {},
            event_marks(d),
            "",
            false,
            false,
            before_closing(d)};
  const auto pair = measure::split_masses(d);
  if (!pair) {
    plot.note = "The result has no split masses of a mechanism 1.";
    return plot;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    plot.curves.push_back({side == 0 ? "A1" : "B1", d.mass_velocity[at((*pair)[side])].component(axis),
                           "line", static_cast<int>(side)});
    show(plot, {"velocity"}, d.model.masses[at((*pair)[side])].name);
  }
  if (d.mass_velocity[at((*pair)[0])].source == "frames")
    plot.note = "From frames: no velocity probe of the split masses.";
  return plot;
}

Plot ring_plot(const Digest& d, const std::string& name) {
  Plot plot{"Contact force on ring " + name,
            "Fig. 13",
            "t, s",
            "force, N",
            {},
            {},
            "",
            false,
            true,
            before_closing(d)};
  const int ring = d.ring(name);
  if (ring < 0) {
    plot.note = "The result has no ring " + name + ".";
    return plot;
  }
  const VectorSeries& force = d.ring_force[at(ring)];
  plot.curves.push_back({"ring " + name, force.norm(), "line", 0});
  show(plot, {"force"}, "ring." + d.model.rings[at(ring)].name);
  plot.marks = event_marks(d);
  if (force.source == "frames") plot.note = "From frames: no force probe of this ring, so peaks are missed.";
  return plot;
}

std::vector<Plot> capture_plots(const std::vector<const Digest*>& results) {
  const Digest& d = *results.front();
  std::vector<Plot> plots{velocity_plot(d, 0), velocity_plot(d, 1), velocity_plot(d, 2), ring_plot(d, "1"),
                          ring_plot(d, "2")};
  Plot mouth{"Area of the mouth",
             "",
             "t, s",
             "area, m²",
             curve_each(results, [](const Digest& r) { return r.mouth_area; }),
             event_marks(d),
             "",
             false,
             true};
  if (mouth.curves.empty()) mouth.note = "The result has fewer than three rings.";
  show(mouth, {"mouth_area"}, "");
  plots.push_back(mouth);
  return plots;
}

double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

Series shown_part(const Series& series, const std::optional<double>& from) {
  if (!from) return series;
  const auto first = std::lower_bound(series.t.begin(), series.t.end(), *from) - series.t.begin();
  return {{series.t.begin() + first, series.t.end()}, {series.v.begin() + first, series.v.end()}};
}

nlohmann::json curve_json(const Curve& curve, const std::optional<double>& from) {
  const Series points = thinned(shown_part(curve.points, from));
  auto x = nlohmann::json::array(), y = nlohmann::json::array();
  for (const double value : points.t) x.push_back(rounded(value));
  for (const double value : points.v) y.push_back(rounded(value));  // nan becomes null: a gap
  return {{"label", curve.label}, {"style", curve.style}, {"colour", curve.colour}, {"x", x}, {"y", y}};
}

}  // namespace

std::string probe_key(const std::string& quantity, const std::string& of) { return quantity + " of " + of; }

std::vector<Mark> event_marks(const Digest& d) {
  std::vector<Mark> marks;
  if (d.model.closing_time) marks.push_back({*d.model.closing_time, "closing"});
  if (const auto t = d.first_event("target_contact")) marks.push_back({*t, "touches target"});
  if (const auto t = d.first_event("mouth_closed")) marks.push_back({*t, "mouth closed"});
  std::sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.at < b.at; });
  return marks;
}

std::vector<Plot> figure_plots(const std::vector<Digest>& results) {
  const auto same = of_case(results);
  switch (results.front().paper_case) {
    case PaperCase::ring_pull:
      return ring_pull_plots(same);
    case PaperCase::edge_closure:
      return edge_closure_plots(same);
    case PaperCase::capture:
      return capture_plots(same);
    default:
      break;
  }
  std::vector<Plot> plots;
  const Digest& d = results.front();
  if (!d.mouth_area.empty()) {
    plots.push_back({"Area of the mouth",
                     "",
                     "t, s",
                     "area, m²",
                     {{d.label(), d.mouth_area, "line", 0}},
                     event_marks(d),
                     "",
                     false,
                     true});
    show(plots.back(), {"mouth_area"}, "");
  }
  return plots;
}

std::vector<Plot> energy_plots(const Digest& d) {
  Plot ledger{"Energy ledger", "", "t, s", "energy, J", {}, {}, "", false, false};
  Plot residual{"Residual of the ledger",
                "",
                "t, s",
                "residual, J",
                {},
                {},
                "Initial energy less all that is accounted for.",
                false,
                false};
  const auto& names = Energies::names();
  for (std::size_t term = 0; term < names.size(); ++term) {
    Series series{d.frame_times, {}};
    for (const Energies& e : d.energies) series.v.push_back(e.values()[term]);
    const bool zero = std::all_of(series.v.begin(), series.v.end(), [](double v) { return v == 0; });
    std::string label = names[term];
    std::replace(label.begin(), label.end(), '_', ' ');
    if (names[term] == "residual") {
      residual.curves.push_back({label, series, "line", 0});
    } else if (!zero) {
      ledger.curves.push_back({label, series, "line", static_cast<int>(ledger.curves.size())});
    }
  }
  if (ledger.curves.empty()) ledger.note = "The run kept no ledger.";
  return {ledger,
          residual,
          {"Greatest tension",
           "",
           "t, s",
           "tension, N",
           {{"of all elements", d.peak_tension, "line", 0}},
           {},
           "",
           false,
           true}};
}

std::string plots_json(const std::vector<Plot>& plots) {
  auto list = nlohmann::json::array();
  for (const Plot& plot : plots) {
    nlohmann::json entry{{"x", plot.x}, {"y", plot.y}, {"equal", plot.equal_axes}, {"zero", plot.from_zero}};
    entry["curves"] = nlohmann::json::array();
    for (const Curve& curve : plot.curves) entry["curves"].push_back(curve_json(curve, plot.from));
    entry["marks"] = nlohmann::json::array();
    for (const Mark& mark : plot.marks) entry["marks"].push_back({{"at", mark.at}, {"label", mark.label}});
    list.push_back(std::move(entry));
  }
  return list.dump();
}

}  // namespace cinch
