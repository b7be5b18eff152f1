// The problems of the study of error against run time: how each is set up, what is compared, by which
// measure.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "plan/simulation.hpp"

namespace cinch::study {

/// One way to compute a problem.
struct Setting {
  std::string method;   ///< "sliding", "contact", that with rules of the paper's (common.hpp), or "threads":
                        ///< no rings
  int elements = 0;     ///< of each thread that slides
  double step = 0;      ///< s; 0: `fraction` of the stable step
  double fraction = 0;  ///< of the stable step
  bool papers = false;  ///< the paper's own choice
  int joint_steps = 1;  ///< for which forces of sliding joints hold; 0: automatic
  int runs = 1;         ///< whose mean counts, where a problem is chaotic
  double closing_fraction = 0;           ///< of the stable step, from the closing time on; 0: as before
  std::string series() const;            ///< what it shares with others of one curve
  std::string but_for_the_step() const;  ///< what it shares with others of other steps
};

/// What is compared, sample after sample; as many numbers in each.
struct Track {
  std::vector<double> times;  ///< s
  std::vector<std::vector<double>> samples;
};

using Errors = std::vector<std::pair<std::string, double>>;

struct Problem {
  std::string name, title;
  std::string measure;  ///< of the first of its errors, in words
  double end = 0;       ///< s
  int samples = 0;      ///< until then
  std::function<Scene(const Setting&)> scene;
  std::function<std::vector<double>(Simulation&)> sample;
  std::function<Errors(const Track& found, const Track& reference)>
      errors;  ///< shares of 1, the first counts
  /// Those of its errors that hang on chance whatever the elements: their convergence is not to be expected.
  std::vector<std::string> chaotic_measures;

  std::function<std::vector<double>(double)> exact;  ///< sample at a time, s; without it:
  std::vector<Setting> reference;                    ///< whose mean is the reference
  std::vector<Setting> settings;

  /// Where a problem is chaotic: begins a run a little apart from the others; runs of its references have
  /// numbers of their own.
  std::function<void(Scene&, int run)> perturb;
  bool chaotic() const { return perturb != nullptr; }
};

/// How much of a problem is computed.
enum class Extent {
  trial,  ///< a few runs within seconds: shows that the study works
  usual,
  full  ///< the finest runs with contact, too
};

/// A weight on a hanging thread, which swings up and down: exact.
Problem weight_on_a_thread(Extent extent);
/// Two masses on a thread over a ring, Atwood's machine: exact.
Problem atwood(Extent extent);
/// Sec. 5.1: a thread pulls a ring.
Problem ring_pull(Extent extent);
/// The same with dampers of another ratio to the critical one.
Problem damped_ring_pull(Extent extent, double damping_ratio);
/// Sec. 5.2: an edge of a hanging net is drawn together.
Problem edge_closure(Extent extent);
/// Sec. 5.3 without what is chaotic in it: the deployed net closes without a target.
Problem net_closing(Extent extent);
/// Sec. 5.3 as a whole.
Problem capture(Extent extent);

/// All of them.
std::vector<Problem> problems(Extent extent);

}  // namespace cinch::study
