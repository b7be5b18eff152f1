// What a run leaves behind, as plain data: the recorder writes it, the reader reads it, report and compare
// use it.
//
// DIR/run.vtkhdf   HDF5, VTKHDF 2.0 UnstructuredGrid (cells are VTK_LINE elements) with groups of our own
// beside it DIR/run.xdmf     the same arrays for ParaView before 5.12 DIR/summary.json
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.hpp"

namespace cinch {

/// What does not change during a run. Node, element and ring order is the user's numbering.
struct ResultModel {
  std::string case_name, title, about, case_toml;  ///< case_toml: resolved, every default written out
  std::string version, commit, compiler, isa;
  int threads = 1;
  double time_step = 0;                        ///< s, before the closing time
  double closing_time_step = 0;                ///< s, from the closing time on
  std::vector<std::array<Index, 2>> elements;  ///< node numbers of each element
  std::vector<double> rest_length;             ///< m, of each element
  std::vector<double> element_radius;          ///< m
  std::vector<int> element_part;               ///< index into parts
  std::vector<double> node_mass;               ///< kg, from the closing time on
  struct Part {
    std::string kind, name;
    bool closing = false;
  };
  std::vector<Part> parts;  ///< kind: "net", "mechanism", "thread", "ring"
  struct Ring {
    std::string name;
    double radius = 0, wire_radius = 0;
  };
  std::vector<Ring> rings;
  struct Joint {
    int part = 0;    ///< the thread: index into parts
    Index ring = 0;  ///< that slides on it
  };
  std::vector<Joint> joints;  ///< sliding ones, thread by thread, in their order along it
  struct Ball {
    std::string name;
    Vec3 center = Vec3::Zero();
    double radius = 0;
  };
  std::vector<Ball> balls;
  struct Mass {
    std::string name;
    Index node = 0;
    double mass = 0;
  };
  std::vector<Mass> masses;            ///< named nodes with a mass of their own
  std::optional<double> closing_time;  ///< s
  struct ProbeColumn {
    std::string name, quantity, of, unit;
  };
  std::vector<ProbeColumn> probes;  ///< one for each scalar column of the probe table
};

/// The energy ledger at one time, J. Initial = sum of the present terms - work put in - booked terms +
/// residual.
struct Energies {
  double kinetic = 0, elastic = 0, contact = 0, gravity = 0;  ///< stored now
  double dissipated_damper = 0, dissipated_contact = 0;       ///< since t = 0
  double work_separation = 0;                                 ///< put in by the closing mechanisms
  double booked_activation = 0;                    ///< energy lost (+) when the closing threads were laid
  double booked_couple = 0;                        ///< energy lost (+) by the couple that eq. (12) drops
  double residual = 0;                             ///< initial - accounted for
  static const std::vector<std::string>& names();  ///< in the order of values()
  std::vector<double> values() const;
  static Energies from_values(const std::vector<double>& values);  ///< the inverse of values()
};

struct Frame {
  double time = 0;  ///< s
  std::int64_t step = 0;
  std::vector<Vec3> position, velocity;  ///< m, m/s: every node
  std::vector<Vec3> contact_force;       ///< N: on every node, from rings and targets together
  std::vector<double> tension;           ///< N: every element
  std::vector<double> strain;            ///< -: every element, negative when slack
  std::vector<std::uint8_t>
      active;  ///< 1 for each element that exists now (closing threads: from the closing time)
  std::vector<Vec3> ring_center, ring_normal, ring_force;  ///< m, -, N: every ring
  std::vector<Index> joint_element;  ///< every joint: the element in which its ring lies, ascending
  std::vector<Vec3> joint_waypoint;  ///< m, every joint: where its thread goes through the ring
  Energies energy;
};

/// Where threads go through the rings that lie in an element, in order from its first node; empty for most.
std::span<const Vec3> waypoints_in(const Frame& frame, Index element);

struct Event {
  double time = 0;
  std::string kind;  ///< ring_contact, target_contact, separation, mouth_closed, mouth_reopened,
                     ///< target_enclosed, target_lost, thread_left, thread_end
  std::string name;  ///< of the ring, target, mechanism or mouth; of the ring and the thread or node in it
};

struct RingRecord {
  std::string name;
  double first_contact_time = -1;  ///< s; -1: never
  double first_contact_force = 0;  ///< N, greatest before the first release
  double peak_force = 0;           ///< N
  double peak_time = -1;           ///< s
};

/// How fast the fastest node was when a run looked at its speeds.
struct Pace {
  double time = 0;   ///< s
  std::string node;  ///< "node 3 of thread.main"
  double speed = 0;  ///< m/s
};

struct StageTime {
  std::string name;
  double seconds = 0;
};

/// A residual above this share of the largest input is a warning: the motion is not to be trusted.
inline constexpr double residual_limit = 0.01;

/// The verdict for machines: written as summary.json (field names as there).
struct Summary {
  std::string status;                 ///< "done", "failed", "interrupted", "terminated"
  std::string message;                ///< why it stopped, when it did not end as planned
  std::vector<std::string> warnings;  ///< what makes the result doubtful
  std::string case_name, version, commit, compiler, isa, host;
  int threads = 1;
  std::int64_t steps = 0;
  double time_step = 0, closing_time_step = 0;  ///< s, before the closing time and from it on
  double simulated_seconds = 0, wall_seconds = 0;
  int joint_steps = 1;  ///< for which forces of sliding joints hold
  Index nodes = 0, elements = 0, rings = 0;
  double stable_step = 0;  ///< s
  std::string stable_step_limited_by;
  std::uint64_t state_hash = 0;
  Energies energy;                   ///< at the end
  double energy_initial = 0;         ///< J
  double relative_residual = 0;      ///< residual over the largest of initial energy and work put in
  double linear_momentum_drift = 0;  ///< kg m/s, impulses of targets, supports and gravity taken off
  std::optional<double> angular_momentum_drift;  ///< kg m^2/s; absent where it is not kept (gravity)
  double max_penetration = 0;                    ///< m
  std::vector<StageTime> stages;
  std::vector<Event> events;
  std::vector<RingRecord> ring_records;
  std::vector<Pace> history;  ///< the last looks at speeds, of a run that failed
  double minutes_per_simulated_second() const {
    return simulated_seconds > 0 ? wall_seconds / 60 / simulated_seconds : 0;
  }
};

}  // namespace cinch
