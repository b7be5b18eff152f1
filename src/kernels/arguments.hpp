// What the kernels read and write: plain pointers and counts, owned by the store and the plan.
// Units are SI; "node", "slot", "force", "ring" tell an array's length.
#pragma once
#include "base/index.hpp"

namespace cinch::kernel {

constexpr Index block_size = 2048;  ///< nodes that are computed and moved together, about
constexpr Index grain = 64;         ///< nodes whose elements share one row of the ledger; whole groups
constexpr Index lanes = 8;          ///< nodes and elements go in groups of so many, whatever the vector width
constexpr Index ring_scratch = 3584;         ///< numbers that a batch of ring contacts works on
constexpr Index sliding_scratch = 2 * 1328;  ///< numbers that a call for sliding joints works on
constexpr Index joint_scratch = 88;          ///< ... and besides for each joint
constexpr Index max_terms = 4;  ///< element forces on a node that one pass adds up, in pairs (+, -)

/// Elements whose lower ends are the nodes of whole groups from `node` on; the upper ends lie `step` nodes
/// further on. Lanes without element have void parameters and give zero force.
struct Span {
  Index node, groups, step;
  Index parameter;  ///< of the first group; the others follow
  Index force;      ///< where the first lane's force goes; the others follow
  Index row_node;   ///< number of `node` in the whole scene, for the ledger; -1: booked elsewhere
  Index stretch;    ///< that takes the same nodes and whose first term this is, if step is 1; or -1
};

constexpr Index palette_fields = 4;  ///< of a row of the palette

/// A single element.
struct Link {
  Index a, b, force;
  Index row;                                     ///< of the ledger, -1: booked elsewhere
  double stiffness, damping, rest_length, give;  ///< as in the palette
};

/// Forces to copy [from, from + count) -> [to, ...), or from -1: to set to zero, before a block's elements.
struct Patch {
  Index to, from, count;
};

/// What elements add to their row of the ledger. Power is that between the last step's forces and this one's:
/// the velocity in between times the mean of both damper forces, which is what a step of central differences
/// takes from the energy m v(n-1/2).v(n+1/2)/2 + k s(n)^2/2, to the last digit but for an element's turning.
struct Book {
  enum Sum { nothing, power, energy, energy_and_power };
  static constexpr int sums = 4;
};

struct AxialArguments {
  const double *x, *y, *z, *vx, *vy, *vz;  ///< node: position, velocity half a step earlier
  const Index* parameter;                  ///< group: its row of the palette
  const double* palette;  ///< row x (k, c, l0, g of axial_law.hpp) x lanes: N/m, N s/m, m, m/N
  double *fx, *fy, *fz;   ///< force: on the element's end a (minus it acts on b), N
  double* booked;         ///< ledger row x lanes: damper power, W, or elastic energy, J
  // as long as power is booked:
  double* damper;       ///< group x lanes: the damper's force in the last step, N
  double* link_damper;  ///< link: the same
  double* due;          ///< ledger row x lanes, with elastic energy: damper power up to now, W; null without
  double dt;            ///< s
};

/// Nodes that follow each other and whose element forces do so, too: node + k takes the sum of force[plus +
/// k] minus force[minus + k] over the terms, in order. What a node lacks points to zeros.
struct Stretch {
  Index node, count, terms;
  Index plus[max_terms], minus[max_terms];
};

/// The force of a link, or a term too many for a stretch, on one node.
struct Kick {
  Index node, force;
  double sign;
};

/// A contact force on a node, N.
struct Load {
  Index node;
  double x, y, z;
};

/// A guided (moves along the axis) or fixed (axis = 0) node.
struct Constraint {
  Index node;
  double ax, ay, az;
  double mass;  ///< kg
};

/// Where a constrained node was before the step.
struct Held {
  double x, y, z, vx, vy, vz;
};

/// What a constraint has taken from its node so far: impulse, N s, and its moment about the origin, N m s.
struct Reaction {
  double impulse[3], moment[3];
};

/// What moving nodes takes in besides element forces, and what it tells.
struct Moving {
  enum Kind { blind, watched, loaded };  ///< nothing; the greatest speed; that, with standing loads
  static constexpr int kinds = 3;
};

struct NodeArguments {
  double *x, *y, *z, *vx, *vy, *vz;  ///< node
  const double* scale;               ///< node: dt / m, s/kg; 0: not moved here
  const double *fx, *fy, *fz;        ///< force, N
  double gravity[3];                 ///< dt g, m/s
  double dt;                         ///< s
  // node: standing loads, forces that hold for several steps, N
  const double *load_x = nullptr, *load_y = nullptr, *load_z = nullptr;
};

/// What node_energies sums up.
struct EnergyArguments {
  const double *x, *y, *z, *vx, *vy, *vz;  ///< node
  const double *gain_x, *gain_y, *gain_z;  ///< node: what the next step adds to the speeds, m/s
  double share;                            ///< of the gain at the time looked at
  const double* mass;                      ///< node, kg
  double gravity[3];                       ///< m/s^2
  Index nodes;
};

/// Kinetic energy m v.(v + 2 share gain)/2, and that in the field of gravity, sum of -m g.x; J.
struct NodeEnergies {
  double kinetic, gravity;
};

/// One element, or one mass as a sphere (a == b), that may touch one ring or ball before the broadphase
/// margin is used up.
struct Pair {
  Index a, b;               ///< nodes
  Index element;            ///< for messages: user's number; sphere_label(node) of a sphere
  Index with;               ///< ring or ball
  double contact_distance;  ///< r_A + r_B: centre lines closer than this touch, m (ball: r_A + R)
  double stiffness;         ///< k_c of eq. (7), N/m^1.5
  double fraction_a,
      fraction_b;  ///< of the end node's own contact, that counts here: 1 / degree; 0: none does
};

/// What stands for the element of a sphere around the node; its own inverse.
constexpr Index sphere_label(Index node) { return -1 - node; }

/// What the batches of ring_lanes.hpp need of a pair with a ring, in one place.
struct RingLane {
  Index a, b, host_a, host_b;  ///< nodes
  double radius;               ///< of the ring, m
  double contact_distance, stiffness;
  double touch_a, touch_b;              ///< squared distance below which an end's own contact counts, or 0
  double share_a, share_b, host_share;  ///< of the stable step, 1/kg
  double held;                          ///< 1: the ring has a node of its own and does not turn
};

struct RingGeometry {
  Index a, b;        ///< host nodes; the same for a ring with a node of its own
  double normal[3];  ///< used when a == b
  double radius;     ///< R_B, m
  double reach;      ///< nothing farther from the centre than this touches the ring, m
};

/// What a ring has felt; every field is written by the one thread that books the ring.
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
  double alpha;              ///< of eq. (9), s/m
  double time, dt;           ///< s; dt 0 books nothing
  double step;               ///< s, for the share of the stable step
};

struct RingArguments {
  ContactArguments contact;
  const RingGeometry* rings;
  RingTally* const* tallies;  ///< ring: where it is booked, or null: booked elsewhere
  Index ring_count;
  const RingLane* lanes;  ///< pair
  double* scratch;  ///< ring_scratch numbers, of which only this call knows what they mean; zero at first
  bool golden;      ///< closest point by golden section, the paper's method
  bool couple;      ///< keep the couple that eq. (12) drops
};

/// A ring that slides on a thread. Those of one thread follow each other in their order along it.
struct Joint {
  Index ring;
  Index host_a, host_b;  ///< host nodes; the same for a ring with a node of its own
  double normal[3];      ///< used when host_a == host_b
  double opening;        ///< radius of the disc that the thread's centre line can pass, m
  double host_least;  ///< the ring's body keeps the ends of its host so far apart, m; 0 without such a host
  double host_stiffness;  ///< ... with this, N/m: a part of it for each thread that slides through the ring
};

constexpr Index joint_loads = 8;         ///< that one evaluation makes of a joint, at most:
constexpr Index joint_thread_loads = 4;  ///< so many on nodes of its thread, the others on its ring's host

/// A thread on which rings slide; its elements are alike.
struct SlidingThread {
  Index node_begin, elements;              ///< its nodes are nodes[node_begin + 0 .. elements]
  Index joint_begin, joint_end;            ///< its joints, in their order along it
  double stiffness, damping, rest_length;  ///< of each element: N/m, N s/m, m
  bool booked;                             ///< what its joints have felt counts here, not elsewhere
};

/// Where a joint stands and what it has felt.
struct JointState {
  Index element;      ///< of its thread: the ring lies in it
  Index passes;       ///< nodes that have passed the ring
  double offset[3];   ///< of the thread's waypoint from the ring's centre, m
  double dissipated;  ///< by dampers beyond straight elements, J; of the whole thread at its first ring
  // as last evaluated in a step, of the first ring in an element
  Index damped, rings;                ///< that element, and how many rings lay in it; rings 0: not known
  double damper, straight_damper;     ///< damper force of the element, and of it as a straight one, N
  double last_length, last_straight;  ///< lengths of both, m; negative: not known
  // as last looked at
  double length;   ///< of its element, m
  double tension;  ///< on both sides of the ring, N
  double energy;   ///< of its element beyond the straight one, J; of several rings at the first
  double along;    ///< unstretched thread from its start to the ring, m: the material coordinate
  double due;      ///< dissipated since the last evaluation in a step, J, as `dissipated`
};

/// Loads of sliding joints: on nodes of threads, on those of the rings' hosts.
struct SlidingLoads {
  Index threads, hosts;
};

struct SlidingArguments {
  ContactArguments contact;  ///< its steps are those between two evaluations
  double ahead;              ///< s: nodes are taken where they will be then
  double since;              ///< s since the last evaluation in a step, from where that took nodes
  const Index* nodes;
  const double* mobility;  ///< of those nodes: 1/m, 1/kg
  const SlidingThread* threads;
  Index thread_count;
  const Joint* joints;
  JointState* states;         ///< joint
  RingTally* const* tallies;  ///< ring: where it is booked, or null
  SlidingLoads* ends;         ///< thread: behind its loads
  /// On a cache line: sliding_scratch numbers and joint_scratch a joint, of which only this call knows what
  /// they mean.
  double* scratch;
};

/// What one pair with a ball has felt, or a sum of such.
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
  const double* centers;      ///< ball x 3, m
  BallTally* const* tallies;  ///< pair: where it is booked, or null: booked elsewhere
};

}  // namespace cinch::kernel
