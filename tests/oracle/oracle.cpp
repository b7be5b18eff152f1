#include "oracle/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "oracle/closest.hpp"

namespace oracle {

using cinch::AssemblyBall;
using cinch::AssemblyElement;
using cinch::AssemblyNode;
using cinch::AssemblyRing;
using cinch::Support;

namespace {

template <class List>
auto& at(List& list, Index i) {
  return list[static_cast<std::size_t>(i)];
}

template <class List>
Index count(const List& list) {
  return static_cast<Index>(list.size());
}

/// Equivalent stiffness of two rounded bodies in contact, eq. (7).
double contact_stiffness(double radius_1, double radius_2, double compliance_1, double compliance_2) {
  const double r = radius_1 * radius_2 / (radius_1 + radius_2);
  return 4 / (3 * std::numbers::pi) * std::sqrt(r) / (compliance_1 + compliance_2);
}

/// The contact law, eqs. (6) and (9).
struct Push {
  double elastic = 0, total = 0;  // N
  double potential = 0;           // J
  double late = 0;                // W/s: what the damper's power counts too much for each second of the step
};

Push hunt_crossley(double stiffness, double alpha, double delta, double delta_dot) {
  const double elastic = stiffness * std::pow(delta, 1.5);
  const double total = std::max(0.0, elastic * (1 + 1.5 * alpha * delta_dot));
  // velocities are those of half a step before: a quarter of the growth of lambda, times the rate squared
  const double growth = total > 0 ? 1.5 * alpha * 1.5 * elastic / delta * delta_dot : 0;
  return {elastic, total, 0.4 * elastic * delta, growth * delta_dot * delta_dot / 4};
}

Vec3 any_normal_to(const Vec3& n) {
  const Vec3 other = std::abs(n.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY();
  return n.cross(other).normalized();
}

}  // namespace

struct Oracle::Motion {
  const std::vector<Vec3>& x;
  const std::vector<Vec3>& v;
  Vec3 place(const AssemblyElement& e, double t) const { return (1 - t) * at(x, e.a) + t * at(x, e.b); }
  Vec3 speed(const AssemblyElement& e, double t) const { return (1 - t) * at(v, e.a) + t * at(v, e.b); }
};

struct Oracle::Frame {
  Vec3 center, velocity;
  Vec3 normal, normal_rate = Vec3::Zero();
  double host_length = 0;  // m, of a host element
};

struct Oracle::Site {
  Index element = 0;
  double t = 0;
  double delta = 0, delta_dot = 0;  // m, m/s
  Vec3 direction = Vec3::Zero();    // n, from the ring or ball to the element
  Vec3 turning = Vec3::Zero();  // m, tangential gradient of the distance with respect to the ring's normal
};

struct Oracle::Sites {
  Site inside, a, b;
};

// ----------------------------------------------------------------------------------------------------
// Set-up and closing

Oracle::Oracle(const cinch::Scene& scene, const cinch::Assembly& assembly)
    : scene_(scene), assembly_(assembly), dt_(scene.time.step) {
  if (!(dt_ > 0)) throw std::invalid_argument("the oracle needs a given time step");
  waits_ = scene.closing.time.has_value() && assembly.has_closing();
  if (waits_) closing_step_ = std::llround(*scene.closing.time / dt_);
}

void Oracle::start() {
  n_ = since_ = contacts_seen_ = 0;
  time_ = 0;
  dt_ = waits_ && closing_step_ == 0 ? scene_.closing.step.value_or(scene_.time.step) : scene_.time.step;
  dissipated_damper_ = dissipated_contact_ = 0;
  last_damper_.clear();
  activated_ = false;
  set_extent();
  x_.clear();
  v_.clear();
  for (Index i = 0; i < nodes_; ++i) {
    const AssemblyNode& node = at(assembly_.nodes, i);
    x_.push_back(node.position);
    v_.push_back(node.support == Support::fixed ? Vec3(Vec3::Zero()) : node.velocity);
  }
  if (waits_ && closing_step_ == 0) activate();
  const Evaluation now = evaluate(x_, v_);
  for (Index i = 0; i < nodes_; ++i) at(v_, i) -= dt_ / 2 * acceleration(i, at(now.force, i));
  ring_force_ = now.ring_force;
}

/// What exists, and what can touch what, before or from the closing time on.
void Oracle::set_extent() {
  const bool all = rings_active();
  nodes_ = all ? count(assembly_.nodes) : assembly_.nodes_before;
  elements_ = all ? count(assembly_.elements) : assembly_.elements_before;
  of_ring_.clear();
  of_ball_.clear();
  for (const AssemblyRing& ring : assembly_.rings) of_ring_.push_back(candidates(ring.parts, ring.element));
  for (const AssemblyBall& ball : assembly_.balls) of_ball_.push_back(candidates(ball.parts, -1));
}

/// Lays the closing threads along their carriers, with the velocities found there: those of half a step back,
/// or where the step changes of the closing time itself.
void Oracle::activate() {
  const double next = scene_.closing.step.value_or(dt_);
  const bool other = n_ > 0 && next != dt_;
  if (other) push_by(dt_ / 2);
  activated_ = true;
  last_damper_.clear();
  set_extent();
  x_.resize(assembly_.nodes.size());
  v_.resize(assembly_.nodes.size());
  for (const cinch::Lay& lay : assembly_.lays) {
    at(x_, lay.node) = (1 - lay.s) * at(x_, lay.a) + lay.s * at(x_, lay.b) + lay.offset;
    at(v_, lay.node) = (1 - lay.s) * at(v_, lay.a) + lay.s * at(v_, lay.b);
  }
  keep_momentum();
  if (n_ > 0) begin_step(next);
  if (other) push_by(-dt_ / 2);
  for (const cinch::Lay& lay : assembly_.lays) {
    at(v_, lay.node) += lay.jump;
    if (at(assembly_.nodes, lay.node).support == Support::fixed) at(v_, lay.node).setZero();
  }
  for (const cinch::Recoil& recoil : assembly_.recoils) at(v_, recoil.node) += recoil.jump;
}

/// Where more of a thread's mass lay on a node than its own nodes weigh there, the rest moves to all of them
/// but its ends, with its momentum.
void Oracle::keep_momentum() {
  for (const cinch::LaidThread& laid : assembly_.laid) {
    Vec3 momentum = Vec3::Zero();
    for (const cinch::Load& load : laid.excess) momentum += load.mass * at(v_, load.node);
    const std::vector<Index>& nodes = at(assembly_.parts, laid.part).nodes;
    double mass = 0;
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
      if (nodes[k] >= assembly_.nodes_before) mass += at(assembly_.nodes, nodes[k]).mass;
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
      if (nodes[k] >= assembly_.nodes_before) at(v_, nodes[k]) += momentum / mass;
  }
}

/// Velocities later by that time, s.
void Oracle::push_by(double time) {
  const Evaluation now = evaluate(x_, v_);
  for (Index i = 0; i < nodes_; ++i) at(v_, i) += time * acceleration(i, at(now.force, i));
}

/// Steps of another length from now on.
void Oracle::begin_step(double dt) {
  time_ += static_cast<double>(n_ - since_) * dt_;
  since_ = n_;
  dt_ = dt;
}

bool Oracle::allowed(Index element, const std::vector<Index>& parts, Index host) const {
  const Index part = at(assembly_.elements, element).part;
  return element != host && std::find(parts.begin(), parts.end(), part) != parts.end();
}

/// Of `degree` elements that meet in a node, each carries that part of what happens at the node.
std::vector<Oracle::Candidate> Oracle::candidates(const std::vector<Index>& parts, Index host) const {
  std::vector<int> degree(assembly_.nodes.size(), 0);
  std::vector<Candidate> list;
  for (Index i = 0; i < elements_; ++i) {
    if (!allowed(i, parts, host)) continue;
    ++at(degree, at(assembly_.elements, i).a);
    ++at(degree, at(assembly_.elements, i).b);
    list.push_back({i, 0, 0});
  }
  if (scene_.contact.shared_node == cinch::SharedNode::paper) return list;
  for (Candidate& c : list) {
    c.part_a = 1.0 / at(degree, at(assembly_.elements, c.element).a);
    c.part_b = 1.0 / at(degree, at(assembly_.elements, c.element).b);
  }
  return list;
}

// ----------------------------------------------------------------------------------------------------
// Stepping

void Oracle::step(int n) {
  for (int i = 0; i < n; ++i) {
    if (waits_ && !activated_ && n_ >= closing_step_) activate();
    const Evaluation now = evaluate(x_, v_);
    book(now);
    integrate(now);
    ++n_;
  }
}

void Oracle::integrate(const Evaluation& now) {
  for (Index i = 0; i < nodes_; ++i) {
    at(v_, i) += dt_ * acceleration(i, at(now.force, i));
    at(x_, i) += dt_ * at(v_, i);
  }
}

void Oracle::book(const Evaluation& now) {
  for (std::size_t e = 0; e < last_damper_.size(); ++e)  // the velocity between two forces does work on both
    dissipated_damper_ += dt_ * 0.5 * (last_damper_[e] + now.damper[e]) * now.rate[e];
  last_damper_ = now.damper;
  dissipated_contact_ += dt_ * (now.contact_power - dt_ * now.contact_late);
  contacts_seen_ += now.contacts;
  ring_force_ = now.ring_force;
}

Vec3 Oracle::acceleration(Index i, const Vec3& force) const {
  const AssemblyNode& node = at(assembly_.nodes, i);
  if (node.support == Support::fixed) return Vec3::Zero();
  const Vec3 free = force / mass(i);
  return node.support == Support::guided ? Vec3(free.dot(node.axis) * node.axis) : free;
}

double Oracle::mass(Index i) const {
  const AssemblyNode& node = at(assembly_.nodes, i);
  return rings_active() ? node.mass : node.mass_before;
}

// ----------------------------------------------------------------------------------------------------
// Forces

Evaluation Oracle::evaluate(const std::vector<Vec3>& x, const std::vector<Vec3>& v) const {
  const Motion m{x, v};
  Evaluation sum;
  sum.force.assign(x.size(), Vec3::Zero());
  sum.damper.assign(static_cast<std::size_t>(elements_), 0.0);
  sum.rate.assign(static_cast<std::size_t>(elements_), 0.0);
  sum.ring_force.assign(assembly_.rings.size(), Vec3::Zero());
  if (scene_.gravity) add_gravity(m, sum);
  for (Index i = 0; i < elements_; ++i) add_element(i, m, sum);
  if (rings_active()) {
    for (Index i = 0; i < count(assembly_.rings); ++i) add_ring(i, m, sum);
  }
  for (Index i = 0; i < count(assembly_.balls); ++i) add_ball(i, m, sum);
  return sum;
}

void Oracle::add_gravity(const Motion& m, Evaluation& sum) const {
  for (Index i = 0; i < nodes_; ++i) {
    at(sum.force, i) += mass(i) * *scene_.gravity;
    sum.gravitational -= mass(i) * scene_.gravity->dot(at(m.x, i));
  }
}

double Oracle::mobility(Index node) const {
  return at(assembly_.nodes, node).support == Support::fixed ? 0.0 : 1 / mass(node);
}

/// The spring's force with which one step to the left and one to the right store what the spring has: the
/// length grew by `before` in the last step, and grows in the next one by what is left after the pull.
double Oracle::spring_force(Index element, double stretch, double before, double drag) const {
  const AssemblyElement& e = at(assembly_.elements, element);
  const double full = e.stiffness * stretch;
  const auto after = [&](double spring) {
    return before - dt_ * dt_ * (mobility(e.a) + mobility(e.b)) * std::max(0.0, spring + drag);
  };
  const double furthest = -1.25 * std::abs(before);  // that it can go back in a step
  const bool was_slack = stretch < before;
  const bool will_be_slack = stretch + std::max(after(full), furthest) < 0;
  if (!was_slack && !will_be_slack) return full;
  // work of both half steps less what they ought to store; has one zero between 0 and the full force
  const auto excess = [&](double spring) {
    return was_slack ? spring * (before + after(spring)) - full * (stretch + after(spring))
                     : -spring * (before + std::max(after(spring), furthest)) - full * (stretch - before);
  };
  if (excess(0) > 0) return 0;
  double low = 0, high = full;
  for (int i = 0; i < 100; ++i) (excess(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  return high;
}

/// The damper works from half a step before to half a step after, as far as the element is taut then; what it
/// would have done before that counts here. It takes no more than the whole rate, unless it always would.
double Oracle::damper_force(Index element, double stretch, double before, double rate) const {
  const AssemblyElement& e = at(assembly_.elements, element);
  const double steady = e.damping * rate;
  if (stretch >= before) return steady;
  const double taut_for = stretch / before + 0.5;  // steps
  const double to_rest = before / (dt_ * dt_ * (mobility(e.a) + mobility(e.b)));
  return std::min(taut_for * steady, std::max(steady, to_rest));
}

/// Spring and damper in parallel, tension only.
void Oracle::add_element(Index i, const Motion& m, Evaluation& sum) const {
  const AssemblyElement& e = at(assembly_.elements, i);
  const Vec3 along = at(m.x, e.b) - at(m.x, e.a);
  const double length = along.norm(), stretch = length - e.rest_length;
  const double rate = along.dot(at(m.v, e.b) - at(m.v, e.a)) / std::max(length, e.rest_length);
  at(sum.rate, i) = rate;
  if (!(stretch > 0)) return;
  const double drag = damper_force(i, stretch, rate * dt_, rate);
  const double spring = spring_force(i, stretch, rate * dt_, drag);
  const double tension = std::max(0.0, spring + drag);
  at(sum.force, e.a) += tension / length * along;
  at(sum.force, e.b) -= tension / length * along;
  sum.elastic += 0.5 * e.stiffness * stretch * stretch;
  at(sum.damper, i) = tension - spring;
}

// ----------------------------------------------------------------------------------------------------
// Thread and ring

/// Every node's contact counts, and of an element's what its deeper end does not have:
///   U = sum_n U_n + sum_e (U_e - max(U_a, U_b)),
/// the dampers as the elastic forces in it, but never less than nothing at a place. k_c is the same for all
/// three sites: depths compare as energies.
template <class Push>
void Oracle::count_once(const Candidate& c, const Sites& sites, Push push) const {
  if (c.part_a == 0) return push(sites.inside, {1, 1});
  if (!(sites.inside.delta > 0)) return;
  const double depth_a = std::max(0.0, sites.a.delta), depth_b = std::max(0.0, sites.b.delta);
  const double held_by_end = std::pow(std::max(depth_a, depth_b) / sites.inside.delta, 1.5);
  push(sites.inside, {1, 1 - held_by_end});
  push(sites.a, {c.part_a - (depth_a >= depth_b), c.part_a});
  push(sites.b, {c.part_b - (depth_a < depth_b), c.part_b});
}

void Oracle::add_ring(Index i, const Motion& m, Evaluation& sum) const {
  const AssemblyRing& ring = at(assembly_.rings, i);
  const Frame frame = frame_of(ring, m);
  for (const Candidate& c : at(of_ring_, i)) {
    const AssemblyElement& e = at(assembly_.elements, c.element);
    const Closest closest =
        closest_to_circle(at(m.x, e.a), at(m.x, e.b), frame.center, frame.normal, ring.radius);
    const Site site = ring_site(i, frame, c.element, closest.t, m);
    sum.contacts += site.delta > 0;
    const auto push = [&](const Site& s, Share share) { push_ring(i, frame, s, share, sum); };
    count_once(c, {site, ring_site(i, frame, c.element, 0, m), ring_site(i, frame, c.element, 1, m)}, push);
  }
}

Oracle::Frame Oracle::frame_of(const AssemblyRing& ring, const Motion& m) const {
  Frame frame;
  if (ring.element < 0) {
    frame.center = at(m.x, ring.node);
    frame.velocity = at(m.v, ring.node);
    frame.normal = ring.normal;
    return frame;
  }
  const AssemblyElement& host = at(assembly_.elements, ring.element);
  const Vec3 along = at(m.x, host.b) - at(m.x, host.a);
  const Vec3 rate = (at(m.v, host.b) - at(m.v, host.a)) / along.norm();
  frame.center = m.place(host, 0.5);
  frame.velocity = m.speed(host, 0.5);
  frame.host_length = along.norm();
  frame.normal = along / frame.host_length;
  frame.normal_rate = rate - rate.dot(frame.normal) * frame.normal;
  return frame;
}

/// With D = P - C = z N + rho u (u the unit radial direction), d^2 = z^2 + (rho - R)^2 = D.D - 2 R rho + R^2:
///   dd/dP = n = (z N + (rho - R) u) / d,
///   dd/dN = (R z / (d rho)) D, of which (R z / d) u is normal to N and can turn it.
Oracle::Site Oracle::ring_site(Index i, const Frame& frame, Index element, double t, const Motion& m) const {
  const AssemblyRing& ring = at(assembly_.rings, i);
  const AssemblyElement& e = at(assembly_.elements, element);
  const Vec3 from_center = m.place(e, t) - frame.center;
  const double z = from_center.dot(frame.normal);
  const Vec3 flat = from_center - z * frame.normal;
  const double rho = flat.norm();
  const Vec3 radial = rho > 0 ? Vec3(flat / rho) : any_normal_to(frame.normal);
  const double distance = std::hypot(z, rho - ring.radius);

  Site site{element, t, e.radius + ring.wire_radius - distance};
  site.direction =
      distance > 0 ? Vec3((z * frame.normal + (rho - ring.radius) * radial) / distance) : -radial;
  if (distance > 0) site.turning = ring.radius * z / distance * radial;
  const double distance_rate =
      site.direction.dot(m.speed(e, t) - frame.velocity) + site.turning.dot(frame.normal_rate);
  site.delta_dot = -distance_rate;
  return site;
}

/// Adds its share of the contact: eq. (10) on the element, eq. (12) on the ring's host, and the couple about
/// the ring's centre, which is what the contact potential's gradient with respect to N leaves on the host's
/// ends.
void Oracle::push_ring(Index i, const Frame& frame, const Site& site, Share share, Evaluation& sum) const {
  if (!(site.delta > 0)) return;
  const AssemblyRing& ring = at(assembly_.rings, i);
  const AssemblyElement& e = at(assembly_.elements, site.element);
  const double stiffness = contact_stiffness(e.radius, ring.wire_radius, e.compliance, ring.compliance);
  const Push push = hunt_crossley(stiffness, scene_.contact.alpha_ring, site.delta, site.delta_dot);
  const double total = share.spring * push.elastic + share.damper * (push.total - push.elastic);
  const Vec3 force = total * site.direction;
  at(sum.force, e.a) += (1 - site.t) * force;
  at(sum.force, e.b) += site.t * force;
  at(sum.ring_force, i) -= force;
  sum.contact += share.spring * push.potential;
  sum.contact_power += share.damper * (push.total - push.elastic) * site.delta_dot;
  sum.contact_late += share.damper * push.late;

  if (ring.element < 0) {
    at(sum.force, ring.node) -= force;
    return;
  }
  const AssemblyElement& host = at(assembly_.elements, ring.element);
  at(sum.force, host.a) -= 0.5 * force;
  at(sum.force, host.b) -= 0.5 * force;
  if (scene_.contact.couple != cinch::RingCouple::conserving) return;
  const Vec3 turn = total / frame.host_length * site.turning;
  at(sum.force, host.a) -= turn;
  at(sum.force, host.b) += turn;
}

// ----------------------------------------------------------------------------------------------------
// Element and ball

void Oracle::add_ball(Index i, const Motion& m, Evaluation& sum) const {
  const AssemblyBall& ball = at(assembly_.balls, i);
  for (const Candidate& c : at(of_ball_, i)) {
    const AssemblyElement& e = at(assembly_.elements, c.element);
    const Site site = ball_site(i, c.element, closest_to_point(at(m.x, e.a), at(m.x, e.b), ball.center).t, m);
    sum.contacts += site.delta > 0;
    const auto push = [&](const Site& s, Share share) { push_ball(i, s, share, sum); };
    count_once(c, {site, ball_site(i, c.element, 0, m), ball_site(i, c.element, 1, m)}, push);
  }
  add_spheres(i, m, sum);
}

/// Masses that touch the ball as spheres, eqs. (6)-(9) between two spheres.
void Oracle::add_spheres(Index i, const Motion& m, Evaluation& sum) const {
  const AssemblyBall& ball = at(assembly_.balls, i);
  for (const Index s : ball.spheres) {
    const cinch::AssemblySphere& sphere = at(assembly_.spheres, s);
    if (sphere.node >= nodes_) continue;
    const Vec3 from_center = at(m.x, sphere.node) - ball.center;
    const double delta = sphere.radius + ball.radius - from_center.norm();
    if (!(delta > 0)) continue;
    const Vec3 direction = from_center.normalized();
    const double delta_dot = -direction.dot(at(m.v, sphere.node));
    const double stiffness = contact_stiffness(sphere.radius, ball.radius,
                                               sphere.compliance.value_or(ball.compliance), ball.compliance);
    const Push push = hunt_crossley(stiffness, scene_.contact.alpha_target, delta, delta_dot);
    at(sum.force, sphere.node) += push.total * direction;
    sum.contact += push.potential;
    sum.contact_power += (push.total - push.elastic) * delta_dot;
    sum.contact_late += push.late;
    ++sum.contacts;
  }
}

Oracle::Site Oracle::ball_site(Index i, Index element, double t, const Motion& m) const {
  const AssemblyBall& ball = at(assembly_.balls, i);
  const AssemblyElement& e = at(assembly_.elements, element);
  const Vec3 from_center = m.place(e, t) - ball.center;
  const double distance = from_center.norm();
  Site site{element, t, e.radius + ball.radius - distance};
  site.direction = distance > 0 ? Vec3(from_center / distance) : any_normal_to(at(m.x, e.b) - at(m.x, e.a));
  site.delta_dot = -site.direction.dot(m.speed(e, t));
  return site;
}

void Oracle::push_ball(Index i, const Site& site, Share share, Evaluation& sum) const {
  if (!(site.delta > 0)) return;
  const AssemblyBall& ball = at(assembly_.balls, i);
  const AssemblyElement& e = at(assembly_.elements, site.element);
  const double stiffness = contact_stiffness(e.radius, ball.radius, e.compliance, ball.compliance);
  const Push push = hunt_crossley(stiffness, scene_.contact.alpha_target, site.delta, site.delta_dot);
  const double total = share.spring * push.elastic + share.damper * (push.total - push.elastic);
  const Vec3 force = total * site.direction;
  at(sum.force, e.a) += (1 - site.t) * force;
  at(sum.force, e.b) += site.t * force;
  sum.contact += share.spring * push.potential;
  sum.contact_power += share.damper * (push.total - push.elastic) * site.delta_dot;
  sum.contact_late += share.damper * push.late;
}

// ----------------------------------------------------------------------------------------------------
// Results

double Evaluation::damper_power() const {
  return std::inner_product(damper.begin(), damper.end(), rate.begin(), 0.0);
}

Result Oracle::result() const {
  const Evaluation now = evaluate(x_, v_);
  Result r{time_ + static_cast<double>(n_ - since_) * dt_, x_, v_, ring_force_};
  for (Index i = 0; i < nodes_; ++i) r.kinetic += 0.5 * mass(i) * at(v_, i).squaredNorm();
  r.elastic = now.elastic;
  r.contact = now.contact;
  r.gravitational = now.gravitational;
  r.dissipated_damper = dissipated_damper_;
  r.dissipated_contact = dissipated_contact_;
  r.contacts_seen = contacts_seen_;
  return r;
}

Vec3 Oracle::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < nodes_; ++i) sum += mass(i) * at(v_, i);
  return sum;
}

Vec3 Oracle::angular_momentum() const {
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < nodes_; ++i) sum += mass(i) * at(x_, i).cross(at(v_, i));
  return sum;
}

}  // namespace oracle
