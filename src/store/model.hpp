// Everything about a scene that does not change while it is stepped, as structure of arrays in the user's
// numbering. What a thread steps through, in the order that suits the machine, is made from it: see
// force_reduction.hpp.
#pragma once
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/arguments.hpp"
#include "scene/assembly.hpp"
#include "store/topology.hpp"

namespace cinch {

// clang-format off: tables
/// The elements that one group of rings or one ball can touch, in ascending order.
struct ContactSet {
  // field                             meaning                                               unit   shape
  std::vector<Index> parts;        // parts of the assembly: what makes two sets the same
  std::vector<Index> elements;     // ascending
  double thickest = 0;             // greatest thread radius                                m
  double thinnest = 1e300;         // least thread radius                                   m
  std::vector<double> fraction_a;  // 1 / degree of end a in the set; 0: the paper's rule   -      elements
  std::vector<double> fraction_b;  // ... of end b                                          -      elements
};

struct Model {
  Index nodes = 0, elements = 0;

  // field                             meaning                                               unit   shape
  LargeVector<double> mass;         // lumped mass, eq. (2)                                kg     node
  LargeVector<double> stiffness;    // k                                                   N/m    element
  LargeVector<double> damping;      // c                                                   N s/m  element
  LargeVector<double> rest_length;  // l0                                                  m      element
  LargeVector<Index> end_a, end_b;  // end nodes                                                  element
  LargeVector<double> radius;       // of the thread                                       m      element
  LargeVector<double> compliance;   // h of eq. (8)                                        1/Pa   element
  std::vector<kernel::Constraint> constraints;  // fixed and guided nodes, ascending

  Topology topology;  // the elements as runs and links

  // contact
  std::vector<ContactSet> contact_sets;
  std::vector<kernel::RingGeometry> rings;
  std::vector<Index> ring_set;  // contact set of each ring                                  ring
  std::vector<double> ring_wire_radius, ring_compliance;  // r_B, h of eq. (8)               m, 1/Pa ring
  struct Sphere {                                         // a mass that touches a ball
    Index node = 0;
    double radius = 0, compliance = 0;
  };
  struct Ball {
    Vec3 center;
    double radius = 0, compliance = 0;
    Index set = 0;
    std::vector<Sphere> spheres;
  };
  std::vector<Ball> balls;
  bool ring_contacts = false;  // some ring feels the contact of a thread

  // sliding joints
  std::vector<kernel::SlidingThread> sliding_threads;
  std::vector<Index> sliding_nodes;      // of those threads, one after the other
  std::vector<Index> sliding_first;      // number of its first element                       sliding thread
  std::vector<kernel::Joint> joints;     // by thread, in their order along it
  std::vector<double> ring_host_length;  // unstretched; 0: a node of its own        m        ring
  std::vector<bool> ring_slides;         //                                                   ring
  std::vector<Index> joint_element;      // of the thread, where the ring lies at first        joint

  bool damped = false;  // some element has a damper
  Vec3 gravity = Vec3::Zero();
  bool has_gravity = false;

  /// Whether threads slide through ring r, which then has no contact.
  bool slides(std::size_t r) const { return !joints.empty() && ring_slides[r]; }
  /// Whether element e belongs to the sliding thread t.
  bool slides_on(std::size_t t, Index e) const {
    return e >= sliding_first[t] && e < sliding_first[t] + sliding_threads[t].elements;
  }
  /// Rows of the damper ledger: one for each grain of nodes.
  Index ledger_rows() const { return (nodes + kernel::grain - 1) / kernel::grain; }
};
// clang-format on

/// Which part of an assembly a model holds.
enum class Stage {
  before_closing,  ///< without closing threads and split masses; mass_before
  closing          ///< everything
};

/// Builds the store; throws CaseError for a node without mass.
Model build_model(const Assembly& assembly, const Scene& scene, Stage stage);

/// 1/m of a node, 1/kg; 0 where it is fixed.
double mobility(const Model& model, Index node);

}  // namespace cinch
