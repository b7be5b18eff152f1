// One pass over a result: everything that verdict and plots need, small enough to keep in memory.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "output/result_reader.hpp"
#include "report/paper_scene.hpp"
#include "report/series.hpp"

namespace cinch {

/// One column of a case's probes, thinned for a chart.
struct ProbeSeries {
  ResultModel::ProbeColumn column;
  Series values;
};

/// What a column is of: "force" for the components of a force, too.
std::string probed_quantity(const ResultModel::ProbeColumn& column);

/// Series come from probes where the run has them, else from its frames.
struct Digest {
  ResultModel model;  ///< its masses without those of rings, which are shown as rings
  std::optional<Summary> summary;
  std::string file;  ///< of the result
  PaperCase paper_case = PaperCase::none;
  std::string unjudged;                                    ///< why a scene like the paper's is not judged
  double look_interval = 0;                                ///< s, between looks for events; 0: not known
  std::vector<double> frame_times;                         ///< s
  std::vector<Energies> energies;                          ///< J, of the frames
  std::vector<VectorSeries> ring_position, ring_force;     ///< m, N: one for each ring
  std::vector<VectorSeries> mass_position, mass_velocity;  ///< m, m/s: one for each named mass
  Series mouth_area, mouth_spread;                         ///< m^2, m
  std::vector<ProbeSeries> probes;                         ///< all but energies, which frames have as well
  Series peak_tension;                                     ///< N, greatest of all elements, from the frames
  double start_speed = 0;                                  ///< m/s, greatest of all nodes in the first frame
  std::optional<Vec3> gravity;                             ///< m/s^2, from the resolved case

  /// Number of the mass whose name is `name` or ends in "." + name; -1 when there is none.
  int mass(const std::string& name) const;
  /// Number of the ring with this name ("1" finds "r1", "ring1", ...); -1 when there is none.
  int ring(const std::string& name) const;
  const RingRecord* record(int ring) const;  ///< of the summary; null when there is none
  /// Time of the first event of a kind; absent when it never came or the run left no summary.
  std::optional<double> first_event(const std::string& kind) const;
  /// Of two kinds of events that undo each other: those of `name` (any, if empty), in their order.
  std::vector<Event> turns(const std::string& kind, const std::string& undone,
                           const std::string& name = "") const;
  double end_time() const { return frame_times.empty() ? 0 : frame_times.back(); }
  /// Elements of the longest thread: what the paper counts as the number of elements.
  int thread_elements() const;
  /// A short name that tells this result from others of the same report.
  std::string label() const;
  std::string own_label;  ///< used instead, where labels would be the same
};

Digest digest(const Result& result);

/// All results of a report; those that would have the same label get the name of their folder.
std::vector<Digest> digest_all(const std::vector<Result>& results);

}  // namespace cinch
