// The plots of a report: the paper's figures for the case, and those that every case has.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/digest.hpp"

namespace cinch {

struct Curve {
  std::string label;
  Series points;               ///< x in t, y in v
  std::string style = "line";  ///< "line", "dash", "points", "reference" (the paper's or the limit's value)
  int colour = 0;              ///< number in the page's palette
};

/// A moment worth a vertical line.
struct Mark {
  double at = 0;
  std::string label;
};

struct Plot {
  std::string title;
  std::string source;  ///< the paper's figure, or empty
  std::string x, y;    ///< axis titles with units
  std::vector<Curve> curves;
  std::vector<Mark> marks;
  std::string note;                           ///< what is missing, what to look at
  bool equal_axes = false;                    ///< a path: the same scale along x and y
  bool from_zero = false;                     ///< y axis begins at 0
  std::optional<double> from = std::nullopt;  ///< curves are shown from this abscissa on
  std::vector<std::string> shows = {};        ///< probes that need no chart besides: keys of probe_key()
};

/// Names what a probe records, whatever the probe's own name.
std::string probe_key(const std::string& quantity, const std::string& of);

/// Closing, first touch and closed mouth, in the order of time.
std::vector<Mark> event_marks(const Digest& d);

/// Plots of the paper's figures for the case of the first result.
std::vector<Plot> figure_plots(const std::vector<Digest>& results);

/// The probes of the first result that `others` do not show: those of the same quantity share charts, as far
/// as there are colours; vectors by their components.
std::vector<Plot> probe_plots(const Digest& result, const std::vector<Plot>& others);

/// Takes away what is beyond `most`, from the quantity that has most charts each time; how many went.
std::size_t leave_out(std::vector<Plot>& plots, std::size_t most);

/// Energy ledger, its residual, greatest tension of the first result.
std::vector<Plot> energy_plots(const Digest& result);

/// The plots as JSON for page.js: curves thinned, six significant digits.
std::string plots_json(const std::vector<Plot>& plots);

}  // namespace cinch
