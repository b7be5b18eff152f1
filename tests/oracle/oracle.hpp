// The oracle: the scheme of the solver once more, as short and plain as it can be written, to check the
// solver with.
//
// One thread, nodes and elements in the assembly's numbering, every allowed element against every ring and
// ball, the closest point by golden section. It shares the scene and the assembly with the solver and nothing
// else.
//
// Scheme: v_{n+1/2} = v_{n-1/2} + dt a(x_n, v_{n-1/2}), x_{n+1} = x_n + dt v_{n+1/2}, v_{-1/2} = v_0 - dt/2
// a(x_0, v_0); where closing.step changes dt, v_n = v_{n-1/2} + dt/2 a(x_n, v_{n-1/2}) and back again. Not
// read from the scene: automatic steps (a step must be given), equilibrium (start from the assembly's
// positions), the distance method and the broadphase margin.
#pragma once
#include <vector>

#include "base/vec3.hpp"
#include "scene/assembly.hpp"
#include "scene/scene.hpp"

namespace oracle {

using cinch::Index;
using cinch::Vec3;

/// Everything that acts at one instant, for given positions and velocities of the nodes that exist.
struct Evaluation {
  std::vector<Vec3> force;       ///< N, on each node, gravity included, supports not yet heeded
  std::vector<Vec3> ring_force;  ///< N, of the threads on each ring
  double elastic = 0;            ///< J, in the elements
  double contact = 0;            ///< J, contact potential
  double gravitational = 0;      ///< J, zero for a node at the origin
  std::vector<double> damper;    ///< N, force of each element's damper
  std::vector<double> rate;      ///< m/s, at which each element becomes longer
  double contact_power = 0;      ///< W, lost in contacts
  double contact_late = 0;       ///< W/s: by how much that is too great, for each second of the step
  long contacts = 0;             ///< elements and spheres that touch a ring or a ball
  double damper_power() const;   ///< W, lost in the elements' dampers
};

/// State after n steps. Before the closing time the vectors hold the nodes that exist by then.
struct Result {
  double time = 0;                  ///< s, n dt
  std::vector<Vec3> position;       ///< m, x_n
  std::vector<Vec3> velocity_half;  ///< m/s, v_{n-1/2}
  std::vector<Vec3> ring_force;     ///< N, at the last force evaluation (x_{n-1}; after start: x_0, v_0)
  double kinetic = 0;               ///< J, of v_{n-1/2}
  double elastic = 0;               ///< J, of x_n
  double contact = 0;               ///< J, of x_n
  double gravitational = 0;         ///< J, of x_n
  double dissipated_damper = 0;     ///< J, summed over the steps
  double dissipated_contact = 0;    ///< J, summed over the steps
  long contacts_seen = 0;           ///< elements in contact, summed over the steps
};

class Oracle {
 public:
  /// Throws std::invalid_argument when the scene gives no time step.
  Oracle(const cinch::Scene& scene, const cinch::Assembly& assembly);

  void start();          ///< to t = 0, velocities half a step before; call it first
  void step(int n = 1);  ///< n steps on
  Result result() const;

  /// Forces and potentials at other places and velocities, one of each for every node that exists.
  Evaluation evaluate(const std::vector<Vec3>& x, const std::vector<Vec3>& v) const;

  bool rings_active() const { return !waits_ || activated_; }
  double mass(Index node) const;      ///< kg, as it counts now
  double mobility(Index node) const;  ///< 1/kg, 0 where the node is fixed
  Vec3 momentum() const;              ///< kg m/s, of v_{n-1/2}
  Vec3 angular_momentum() const;      ///< kg m^2/s about the origin, of x_n and v_{n-1/2}

 private:
  /// An element that may touch a ring or ball, and how much of the contact at its end nodes it carries; 0
  /// where elements count by themselves.
  struct Candidate {
    Index element = 0;
    double part_a = 0, part_b = 0;
  };
  /// Of a contact's elastic force and energy, and of its damper.
  struct Share {
    double spring, damper;
  };
  struct Frame;   // a ring's centre and normal with their rates
  struct Site;    // geometry of one contact
  struct Sites;   // of an element: at its closest point, at its ends
  struct Motion;  // positions and velocities

  void set_extent();
  void activate();
  void keep_momentum();
  void push_by(double time);
  void begin_step(double dt);
  void integrate(const Evaluation& now);
  void book(const Evaluation& now);
  Vec3 acceleration(Index node, const Vec3& force) const;

  std::vector<Candidate> candidates(const std::vector<Index>& parts, Index host) const;
  bool allowed(Index element, const std::vector<Index>& parts, Index host) const;

  void add_gravity(const Motion& m, Evaluation& sum) const;
  double spring_force(Index element, double stretch, double before, double drag) const;
  double damper_force(Index element, double stretch, double before, double rate) const;
  void add_element(Index element, const Motion& m, Evaluation& sum) const;
  void add_ring(Index ring, const Motion& m, Evaluation& sum) const;
  void add_ball(Index ball, const Motion& m, Evaluation& sum) const;
  void add_spheres(Index ball, const Motion& m, Evaluation& sum) const;

  Frame frame_of(const cinch::AssemblyRing& ring, const Motion& m) const;
  Site ring_site(Index ring, const Frame& frame, Index element, double t, const Motion& m) const;
  Site ball_site(Index ball, Index element, double t, const Motion& m) const;
  void push_ring(Index ring, const Frame& frame, const Site& site, Share share, Evaluation& sum) const;
  void push_ball(Index ball, const Site& site, Share share, Evaluation& sum) const;
  template <class Push>
  void count_once(const Candidate& c, const Sites& sites, Push push) const;

  cinch::Scene scene_;
  cinch::Assembly assembly_;
  double dt_ = 0;
  bool waits_ = false;  // rings and closing threads come in at step closing_step_
  bool activated_ = false;
  long closing_step_ = 0;
  long n_ = 0, since_ = 0;          // steps done, now and when dt_ became what it is
  double time_ = 0;                 // s, of that step
  Index nodes_ = 0, elements_ = 0;  // that exist now
  std::vector<std::vector<Candidate>> of_ring_, of_ball_;

  std::vector<Vec3> x_, v_;  // x_n, v_{n-1/2}
  std::vector<Vec3> ring_force_;
  std::vector<double> last_damper_;  ///< N, by element; empty before the first step of a phase
  double dissipated_damper_ = 0, dissipated_contact_ = 0;
  long contacts_seen_ = 0;
};

}  // namespace oracle
