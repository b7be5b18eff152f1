// What the kernels read and write: plain pointers and counts, owned by the store and the plan.
// Units are SI; "node", "element", "ring" tell an array's length.
#pragma once
#include "base/index.hpp"

namespace cinch::kernel {

constexpr Index block_size =
    256;                    ///< elements or nodes of a block: the unit of work, the same for any thread count
constexpr Index lanes = 8;  ///< fixed lanes of a block's sums: the same bits for every vector width

/// A stretch of elements whose end nodes rise by one: element + k joins nodes a + k and b + k.
struct Span {
  Index element, count, a, b;
};

/// A block of elements: spans [span_begin, span_end).
struct ElementBlock {
  Index span_begin, span_end;
};

struct AxialArguments {
  const double *x, *y, *z, *vx, *vy, *vz;  ///< node: position, velocity half a step earlier
  const double* stiffness;                 ///< element: k, N/m
  const double* damping;                   ///< element: c, N s/m
  const double* rest_length;               ///< element: l0, m
  double *fx, *fy, *fz;                    ///< element: force on its end a (minus it acts on b), N
  double* dissipated;                      ///< element block x lanes: sum of damper power times dt, J
  double dt;                               ///< s; 0 books nothing
};

/// One summand of a stretch: node + k takes sign times the force of element + k.
struct GatherSource {
  Index element;
  double sign;
};

/// Nodes [node, node + count) whose elements follow each other likewise: the sum of sources, in order.
struct GatherStretch {
  Index node, count;
  Index source_begin, source_end;
};

/// A contact load that one node takes: force[slot].
struct LoadEntry {
  Index node, slot;
};

/// A guided (moves along axis) or fixed (axis = 0) node.
struct Constraint {
  Index node;
  double ax, ay, az;
};

/// What a constraint has taken from its node so far: impulse, N s, and its moment about the origin, N m s.
struct Reaction {
  double impulse[3], moment[3];
};

/// A block of nodes [first, first + count) with what it gathers.
struct NodeBlock {
  Index first, count;
  Index stretch_begin, stretch_end;
  Index constraint_begin, constraint_end;
};

struct NodeArguments {
  double *x, *y, *z, *vx, *vy, *vz;   ///< node
  const double *mass, *inverse_mass;  ///< node, kg, 1/kg
  const double *fx, *fy, *fz;         ///< element: force on its end a, N
  const GatherStretch* stretches;
  const GatherSource* sources;
  const double *load_x, *load_y, *load_z;  ///< slot: contact loads, N
  const LoadEntry* entries;
  const Index* entry_begin;  ///< node block + 1: its stretch of entries
  const Constraint* constraints;
  Reaction* reactions;  ///< constraint
  double gravity[3];    ///< m/s^2
  double dt;            ///< s
};

/// What a node block saw: greatest squared speed, and a sum that is finite as long as every speed is.
struct Watch {
  double greatest, sum;
};

/// One element, or one mass as a sphere (a == b), that may touch one ring or ball before the broadphase
/// margin is used up.
struct Candidate {
  Index a, b;                 ///< nodes
  Index element;              ///< for messages; sphere_label(node) of a sphere
  double contact_distance;    ///< r_A + r_B: centre lines closer than this touch, m (ball: r_A + R)
  double stiffness;           ///< k_c of eq. (7), N/m^1.5
  double weight_a, weight_b;  ///< share of the end node's contact to take off: (degree - 1) / degree, or 0
};

/// What stands for the element of a sphere around the node; its own inverse.
constexpr Index sphere_label(Index node) { return -1 - node; }

struct RingGeometry {
  Index a, b;        ///< host nodes; the same for a ring with a node of its own
  double normal[3];  ///< used when a == b
  double radius;     ///< R_B, m
  double reach;      ///< nothing farther from the centre than this touches the ring, m
};

/// What a ring has felt; every field is written by the one thread that owns the ring.
struct RingTally {
  double force[3];           ///< now, N
  double potential;          ///< contact energy now, J
  double dissipated;         ///< J
  double couple_work;        ///< energy lost by the dropped couple of eq. (12), J
  double couple_impulse[3];  ///< angular impulse of the couple that was dropped or that the ring's support
                             ///< took, N m s
  double peak_force, peak_time;   ///< N, s
  double first_time, first_peak;  ///< s (-1: never touched), N (greatest before the first release)
  double max_penetration;         ///< m
  double stiffest;       ///< greatest share of the stable step used by its contacts, see contact_item.hpp
  double stiffest_time;  ///< s
  Index stiffest_element;
  int state;  ///< 0 never touched, 1 in its first contact, 2 released
};

struct ContactArguments {
  const double *x, *y, *z, *vx, *vy, *vz;  ///< node
  const double* node_share;  ///< node: 1 / (mass x what the elements leave of the stable step), 1/kg
  const Candidate* candidates;
  double *load_x, *load_y, *load_z;  ///< slot: 2 i and 2 i + 1 for candidate i's ends
  double alpha;                      ///< of eq. (9), s/m
  double time, dt;                   ///< s; dt 0 books nothing
  double step;                       ///< s, for the share of the stable step
};

struct RingArguments {
  ContactArguments contact;
  const RingGeometry* rings;
  const Index* candidate_begin;  ///< ring + 1
  RingTally* tallies;            ///< ring
  Index host_slot;               ///< first of the rings' slots: host_slot + 2 r and + 1
  bool golden;                   ///< closest point by golden section, the paper's method
  bool couple;                   ///< keep the couple that eq. (12) drops
};

/// What the candidates of one chunk on a ball have felt.
struct BallTally {
  double potential;              ///< now, J
  double dissipated;             ///< J
  double impulse[3], moment[3];  ///< on the nodes, N s; about the origin, N m s
  double max_penetration;        ///< m
  double first_time;             ///< s, -1: never touched
  double stiffest, stiffest_time;
  Index stiffest_element;
};

struct BallArguments {
  ContactArguments contact;
  double center[3], radius;  ///< m
  Index first_slot;          ///< slot of candidate 0's end a
};

}  // namespace cinch::kernel
