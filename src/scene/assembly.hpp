// The scene cut into nodes and elements, in the user's numbering: the one place that knows both the named
// parts and the numbers. The store is filled from it, results are written in its order.
//
// Numbering: nodes and elements that exist from the start come first (nets row by row, towing threads,
// threads, rings with a node of their own), those of the closing threads last. The scene before the closing
// time is therefore the front part of the scene after it.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/large.hpp"
#include "scene/scene.hpp"

namespace cinch {

enum class PartKind { net, mechanism, thread, ring };

/// A named stretch of nodes and elements.
struct Part {
  PartKind kind;
  std::string name;
  Index first_element = 0, elements = 0;  ///< its elements are consecutive
  std::vector<Index> nodes;  ///< along a thread in order; of a net row by row; shared nodes included
  bool closing = false;      ///< exists from the closing time on

  std::string reference() const;  ///< "net.main", "thread.c_top", ...
};

/// "net", "mechanism", "thread" or "ring".
const char* kind_name(PartKind kind);

struct AssemblyNode {
  Vec3 position;           ///< m, at t = 0 (closing nodes: laid along their carriers)
  Vec3 velocity;           ///< m/s, at t = 0
  double mass = 0;         ///< kg, eq. (2); from the closing time on where a closing time exists
  double mass_before = 0;  ///< kg, before the closing time: closing threads and split masses superposed
  Support support = Support::free;
  Vec3 axis = Vec3::UnitX();  ///< guide direction
};

struct AssemblyElement {
  Index a = 0, b = 0;      ///< end nodes
  double rest_length = 0;  ///< l0, m
  double stiffness = 0;    ///< k = E A / l0, N/m
  double damping = 0;      ///< c, N s/m
  double radius = 0;       ///< of the thread, m
  double compliance = 0;   ///< h of eq. (8), 1/Pa
  Index part = 0;
};

/// Where a node of a closing thread lies before and at the closing time: x = (1 - s) x_a + s x_b.
struct Lay {
  Index node = 0;
  Index a = 0, b = 0;
  double s = 0;
  Vec3 offset = Vec3::Zero();  ///< m, of an overhang
  Vec3 jump = Vec3::Zero();    ///< separation velocity of a split mass, m/s
};

/// Velocity that a launcher takes when its two split masses do not balance, m/s; keeps linear momentum exact.
struct Recoil {
  Index node = 0;
  Vec3 jump = Vec3::Zero();
};

/// A thread that slides through a ring.
struct Threading {
  Index part = 0;
  double along = 0;       ///< where the ring stands at first: elements from the thread's start
  double coordinate = 0;  ///< the same as unstretched thread, m
  double side = 1;        ///< 1: the thread goes where the ring's normal points to; -1: the other way
};

/// The thread that comes nearest to sliding through a ring.
struct Miss {
  Index part = -1;       ///< -1: none crosses the ring's plane
  double distance = 0;   ///< by which it lies outside of the opening, m
  double thickness = 0;  ///< m, where it goes through the ring and is too thick for the opening; else 0
};

struct AssemblyRing {
  std::string name;
  Index element = -1;                   ///< host element, or -1
  Index node = -1;                      ///< own node, or -1
  Vec3 normal = Vec3::UnitX();          ///< of a ring with a node of its own
  double radius = 0;                    ///< R_B, of the wire's centre line, m
  double wire_radius = 0;               ///< r_B, m
  double compliance = 0;                ///< h of eq. (8), 1/Pa
  std::vector<Index> parts;             ///< the threads whose contact it can feel
  std::vector<Threading> threadings{};  ///< the threads that slide through it: none has contact with it
  Index host_a = -1, host_b = -1;       ///< end nodes of the host element, or twice its own node
  std::optional<Miss> missed{};         ///< of an automatic joint that no thread can slide through
};

/// A mass on a node.
struct Load {
  Index node = 0;
  double mass = 0;  ///< kg
};

/// How long a closing thread is, what it is laid over, and what it weighs on until then.
struct LaidThread {
  Index part = 0;
  double length = 0, covered = 0;  ///< unstretched, m; with its overhangs
  double mass = 0;                 ///< kg, of its elements
  std::vector<Load> excess{};  ///< of mass_before over its nodes' masses where they lie; sums up to nothing
  std::map<int, Lay> elsewhere{};  ///< where nodes that are other parts' would be laid, by number; no node
  double strain() const { return covered / length - 1; }
};

struct AssemblyBall {
  std::string name;
  Vec3 center;
  double radius = 0;
  double compliance = 0;       ///< 1/Pa
  std::vector<Index> parts;    ///< the parts that can touch it
  std::vector<Index> spheres;  ///< the masses that can touch it
};

/// A mass that touches targets as a sphere around its node.
struct AssemblySphere {
  std::string name;  ///< as a NamedNode
  Index node = 0;
  double radius = 0;                 ///< m
  std::optional<double> compliance;  ///< h of eq. (8), 1/Pa; none: as the target's
  Index part = 0;                    ///< touches what this part touches
};

/// A node that carries a mass worth naming in results: "mechanism.m1.a", "thread.main.start", ...
struct NamedNode {
  std::string name;
  Index node = 0;
  double mass = 0;  ///< kg, the extra mass
};

struct Assembly {
  std::vector<Part> parts;
  LargeVector<AssemblyNode> nodes;              ///< as they begin; see forget_start()
  LargeVector<AssemblyElement> elements;        ///< what models are built from; see forget_start()
  Index nodes_before = 0, elements_before = 0;  ///< what exists before the closing time
  std::vector<Lay> lays;                        ///< one for each node from nodes_before on, in order
  std::vector<LaidThread> laid;                 ///< closing threads
  std::vector<Recoil> recoils;                  ///< launchers, where not zero
  std::vector<AssemblyRing> rings;
  std::vector<AssemblySphere> spheres;
  std::vector<AssemblyBall> balls;
  std::vector<NamedNode> named;
  std::map<std::string, Net> net_shapes;  ///< what places such as "top_left" mean

  bool has_closing() const { return !lays.empty(); }
  Index node_count() const { return nodes_before + static_cast<Index>(lays.size()); }
  /// Nodes between the ends of a closing thread that exist from the closing time on.
  std::vector<Index> laid_nodes(const LaidThread& thread) const;
  /// The part that an element belongs to.
  const Part& part_of(Index element) const;
  /// Frees nodes and elements, which models and state hold from the start on: two fifths of the memory of a
  /// large net. What has a name stays.
  void forget_start();
  /// Number of a node by its part reference ("thread.main.start", "net.main.knot.3.4"); throws CaseError when
  /// there is none.
  Index node_of(const std::string& reference) const;
  Index node_in_net(const Part& part, const std::string& place) const;
  /// Number of a ring by its name or "ring.NAME"; throws CaseError when there is none.
  Index ring_of(const std::string& reference) const;
};

/// Cuts a scene into nodes and elements; throws CaseError with the place in the case file for impossible
/// scenes (unknown references, a polyline of length zero, a ring on an element that does not exist, ...).
Assembly assemble(const Scene& scene);

}  // namespace cinch
