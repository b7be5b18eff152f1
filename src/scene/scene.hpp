// The validated description of a scene: every default written out, SI units, angles in radians.
// The case reader fills it, the assembly turns it into nodes and elements. It knows neither.
//
// Parts are named; other parts refer to them by "kind.name[.place]":
//   net.NAME.top|right|bottom|left            an edge (polyline of nodes, clockwise: left to right on top,
//                                             top to bottom on the right, right to left at the bottom, ...)
//   net.NAME.top_left|top_right|bottom_right|bottom_left   a corner node
//   net.NAME.knot.I.J                         the knot in column I (0 = left), row J (0 = bottom)
//   thread.NAME.start|end|node.K              a node of a thread (K = 0 .. elements)
//   mechanism.NAME                            its towing thread (polyline) ...
//   mechanism.NAME.launcher|a|b               ... or one of its masses
//   ring.NAME                                 a ring (the node that carries a free, guided or fixed ring)
#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"

namespace cinch {

/// Where a part stands in the case file, for messages that arise after parsing.
struct SourceRef {
  std::string text;  ///< "file:line:column", empty when the scene was built in code
};

enum class DampingRule {
  element,   ///< c = 2 zeta sqrt(k m_e), m_e the element's mass
  stiffness  ///< c = (2 zeta / omega_1) k, omega_1 given
};

struct Material {
  std::string name;
  double youngs_modulus = 0;     ///< Pa
  double poissons_ratio = 0.3;   ///< -
  double density = 0;            ///< kg/m^3
  double damping_ratio = 0.106;  ///< zeta, -
  DampingRule damping_rule = DampingRule::element;
  double damping_frequency = 0;  ///< omega_1 of the stiffness rule, rad/s
  SourceRef source;
};

enum class Support { free, guided, fixed };

/// The body of a node's mass, as far as targets feel it.
struct Sphere {
  double radius = 0;            ///< m; 0: a point, which touches nothing
  double youngs_modulus = 0;    ///< Pa; 0: as the target that it touches
  double poissons_ratio = 0.3;  ///< -
};

/// What hangs on one node besides the threads' own mass.
struct NodeSpec {
  std::string on;   ///< share the node of another part ("mechanism.m1.a", "net.main.top_left"), or empty
  double mass = 0;  ///< kg, added to the threads' share
  Support support = Support::free;
  Vec3 axis = Vec3::UnitX();     ///< direction of motion of a guided node
  std::optional<Vec3> velocity;  ///< m/s, instead of the part's own initial velocity
  Sphere sphere;                 ///< touches targets where its thread or net does
  SourceRef source;
};

/// A thread: either laid along points, or along other parts from the closing time on.
struct Thread {
  std::string name;
  std::string material;
  double diameter = 0;  ///< m
  int elements = 8;
  std::vector<Vec3> points;        ///< polyline, m (empty when `along` is used)
  std::vector<std::string> along;  ///< closing thread: edges and mechanisms it is laid along, in order
  double overhang_start = 0;       ///< m, straight continuation before the first part of `along`
  double overhang_end = 0;         ///< m, and behind the last one
  double length = 0;               ///< unstretched length, m; 0: as laid
  Vec3 velocity = Vec3::Zero();    ///< initial velocity of all nodes, m/s (threads given by points)
  NodeSpec start, end;
  std::map<int, NodeSpec>
      nodes;  ///< further nodes with a mass, support or shared place, by number 0..elements
  bool closing() const { return !along.empty(); }
  SourceRef source;
};

/// A rectangular net of square meshes in the plane spanned by x_axis and y_axis.
struct Net {
  std::string name;
  std::string material;
  double diameter = 0;           ///< m
  double width = 0, height = 0;  ///< unstretched size along x_axis and y_axis, m
  double mesh = 0;               ///< m
  int elements_per_side = 1;     ///< sub-elements of each mesh side
  Vec3 center = Vec3::Zero();    ///< m
  Vec3 x_axis = Vec3::UnitX(), y_axis = Vec3::UnitY();
  double stowed_factor = 1;               ///< initial size over unstretched size
  Vec3 velocity = Vec3::Zero();           ///< m/s
  std::map<std::string, NodeSpec> nodes;  ///< by place: "top_left", "knot.3.4", ...
  int columns() const { return static_cast<int>(width / mesh + 0.5); }  ///< meshes along x_axis
  int rows() const { return static_cast<int>(height / mesh + 0.5); }    ///< meshes along y_axis
  SourceRef source;
};

enum class RingHost {
  element,  ///< centre at the midpoint of an element, normal along it
  node      ///< its own node with the ring's mass (free, guided or fixed); the normal is constant
};

enum class RingJoint {
  contact,   ///< the thread touches the ring's wire, eqs. (3)-(12)
  sliding,   ///< the ring lies inside an element of the thread and slides without friction: sliding_joint.cpp
  automatic  ///< sliding where that can be (threading.hpp), else contact
};

struct Ring {
  std::string name;
  double diameter = 0;           ///< of the wire's centre line, m
  double wire_diameter = 0;      ///< m
  double mass = 0;               ///< kg
  double youngs_modulus = 0;     ///< Pa
  double poissons_ratio = 0.33;  ///< -
  RingHost host = RingHost::node;
  std::string element_of;        ///< host element: "net.main.top" or "thread.main"
  int element = 0;               ///< ... and its number along that edge or thread, from 0
  Vec3 center = Vec3::Zero();    ///< m (node host)
  Vec3 normal = Vec3::UnitX();   ///< unit (node host)
  Vec3 velocity = Vec3::Zero();  ///< m/s (node host)
  Support support = Support::free;
  Vec3 axis = Vec3::UnitX();         ///< guide axis
  std::vector<std::string> threads;  ///< names of the threads it can touch; empty: every thread
  RingJoint joint = RingJoint::automatic;
  SourceRef source;
};

/// A split closing mechanism (paper Sec. 2): towing thread from a corner to a launcher that sheds masses a
/// and b.
struct Mechanism {
  std::string name;
  std::string corner;  ///< "net.main.top_left"
  std::string towing_material;
  double towing_diameter = 0;  ///< m
  double towing_length = 0;    ///< unstretched, m
  int towing_elements = 1;
  double launcher_mass = 0;  ///< kg, what remains after the separation
  double split_mass = 0;     ///< kg, each of the two
  Sphere launcher_sphere, split_sphere;
  Vec3 launch_velocity = Vec3::Zero();  ///< m/s at t = 0
  Vec3 separation_a = Vec3::Zero();     ///< m/s, added to mass a at the closing time
  Vec3 separation_b = Vec3::Zero();     ///< m/s
  double initial_stretch = 1;  ///< initial towing length over unstretched (a stowed net: its stowed factor)
  SourceRef source;
};

struct BallTarget {
  std::string name;
  Vec3 center = Vec3::Zero();   ///< m
  double radius = 0;            ///< m
  double youngs_modulus = 0;    ///< Pa
  double poissons_ratio = 0.3;  ///< -
  std::vector<std::string>
      touches;  ///< parts that can touch it ("net.main", "thread.c1", "mechanism.m1"); empty: all
  SourceRef source;
};

enum class RingCouple {
  conserving,
  paper
};  ///< eq. (12) with the couple about the ring's centre, or without
enum class DistanceMethod { exact, golden };  ///< closest point of segment and circle
enum class SharedNode { once, paper };  ///< a contact at a node shared by elements: counted once, or by each

enum class Leaving { stop, event };  ///< a thread that leaves a ring that it passed through

struct Contact {
  double alpha_ring = 0.05;    ///< alpha of eq. (9) for thread and ring, s/m
  double alpha_target = 0.05;  ///< ... for element and target, s/m
  RingCouple couple = RingCouple::conserving;
  DistanceMethod distance = DistanceMethod::exact;
  SharedNode shared_node = SharedNode::once;
  Leaving leaving = Leaving::stop;
  double margin = 0;  ///< broadphase margin, m; 0: chosen from the element lengths
};

struct Closing {
  std::optional<double> time;    ///< s; absent: nothing closes in this scene
  std::optional<double> step;    ///< s, from then on; 0: automatic; absent: as TimeSpec's
  std::optional<double> safety;  ///< of an automatic step from then on; absent: as TimeSpec's
  SourceRef source;
  SourceRef step_source;
};

enum class EndWhen { never, mouth_closed };

struct TimeSpec {
  double end = 0;                     ///< s
  EndWhen end_when = EndWhen::never;  ///< what ends the run earlier
  double end_delay = 0;               ///< s that it goes on after that
  double step = 0;                    ///< s; 0: automatic
  double safety = 0.4;                ///< automatic step over the stable bound
  int joint_steps = 0;                ///< steps for which forces of sliding joints hold; 0: automatic
  bool allow_unstable = false;        ///< accept a step above the bound
  double speed_limit = 1e5;           ///< m/s, a faster node stops the run
  double residual_limit = 0.05;       ///< of the energy ledger, relative; a greater one stops the run
  SourceRef source;                   ///< of time.step_s where given, else of [time]
  SourceRef joint_steps_source;       ///< the same of time.joint_steps
  SourceRef end_when_source;          ///< the same of time.end_when
};

struct OutputSpec {
  double frame_interval = 0.01;     ///< s
  double probe_interval = 0;        ///< s; 0: as the frames
  bool ledger = true;               ///< keep the energy ledger
  bool compress = false;            ///< deflate frames
  bool checkpoint = true;           ///< keep a checkpoint to go on from
  double checkpoint_interval = 0;   ///< s of simulated time between two; 0: none by it
  double checkpoint_run_time = 60;  ///< s of run time between two; 0: none by it

  /// s between two samples, at which probes are taken and events looked for
  double sample_interval() const { return probe_interval > 0 ? probe_interval : frame_interval; }
};

enum class ProbeQuantity {
  position,
  displacement,
  velocity,
  speed,
  force,
  tension,
  material_coordinate,
  mouth_area,
  mouth_spread,
  energy
};

struct Probe {
  std::string name;
  std::string of;  ///< part reference; empty for mouth and energy
  ProbeQuantity quantity = ProbeQuantity::position;
  SourceRef source;
};

struct Scene {
  std::string name;           ///< case name (the file's stem)
  std::string title, about;   ///< one line; what to expect
  std::string resolved_toml;  ///< the case with every default written out
  std::map<std::string, Material> materials;
  std::vector<Net> nets;  ///< in file order; order is the numbering
  std::vector<Mechanism> mechanisms;
  std::vector<Thread> threads;
  std::vector<Ring> rings;
  std::vector<BallTarget> targets;
  Contact contact;
  Closing closing;
  std::optional<Vec3> gravity;  ///< m/s^2
  bool equilibrium = false;     ///< start from static equilibrium under gravity
  SourceRef equilibrium_source;
  TimeSpec time;
  OutputSpec output;
  std::vector<Probe> probes;
};

}  // namespace cinch
