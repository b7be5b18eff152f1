#include "report/paper_scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "report/html.hpp"

namespace cinch {
namespace {

using Values = std::vector<double>;

constexpr double kTolerance = 0.005;  // of the paper's value; of one unit where that is 0

/// What the paper gives: one value, or two ends where its tables contradict each other or leave room.
struct Given {
  double low, high;
  Given(double value) : low(value), high(value) {}
  Given(double least, double greatest) : low(least), high(greatest) {}
  /// How far outside a value lies; not a number for what is none.
  double off(double value) const { return std::max({low - value, value - high, 0.0}); }
  double slack() const { return kTolerance * (high == 0 && low == 0 ? 1 : std::max(-low, high)); }
};

/// The quantities in which a scene differs from the paper's, in the order in which they are asked for.
class Differences {
 public:
  /// Where the next quantities stand in the paper.
  void source(const char* place) { source_ = place; }

  void number(const std::string& what, const char* unit, double here, Given paper) {
    if (paper.off(here) <= paper.slack()) return;
    std::string given = html::plain(paper.low, unit);
    if (paper.low < paper.high) given += " to " + html::plain(paper.high, unit);
    add(what + " " + html::plain(here, unit) + ", the paper's " + given);
  }
  /// Of several parts: the value farthest from the paper's.
  void numbers(const std::string& what, const char* unit, const Values& here, Given paper) {
    const auto nearer = [&](double a, double b) { return paper.off(a) < paper.off(b); };
    number(what, unit, *std::max_element(here.begin(), here.end(), nearer), paper);
  }
  void vector(const std::string& what, const char* unit, const Vec3& here, const Vec3& paper) {
    for (int axis = 0; axis < 3; ++axis)
      number(what + " along " + "XYZ"[axis], unit, here[axis], paper[axis]);
  }
  void fact(const std::string& what, bool here) {
    if (!here) add(what + ": no, the paper's: yes");
  }

  std::string text() const {
    if (count_ < 2) return first_;
    return first_ + "; " + std::to_string(count_ - 1) + (count_ == 2 ? " more differs" : " more differ");
  }

 private:
  void add(const std::string& text) {
    if (count_++ == 0) first_ = text + " (" + source_ + ")";
  }
  std::string source_, first_;
  int count_ = 0;
};

template <class Part, class Get>
Values of_each(const std::vector<Part>& parts, Get get) {
  Values values;
  for (const Part& part : parts) values.push_back(std::invoke(get, part));
  return values;
}

void compare_material(const std::string& whose, const Material& here, Given modulus, double poisson,
                      double density, Differences& d) {
  d.number(whose + " Young's modulus", "Pa", here.youngs_modulus, modulus);
  d.number(whose + " Poisson's ratio", "", here.poissons_ratio, poisson);
  d.number(whose + " density", "kg/m^3", here.density, density);
}

// The paper does not say which diameter of a ring it gives: inner, of the wire's centre line, or outer.
void compare_rings(const std::vector<Ring>& rings, double diameter, double wire, double mass,
                   Differences& d) {
  d.numbers("ring's diameter", "m", of_each(rings, &Ring::diameter), {diameter - wire, diameter + wire});
  d.numbers("ring's wire", "m", of_each(rings, &Ring::wire_diameter), wire);
  d.numbers("ring's mass", "kg", of_each(rings, &Ring::mass), mass);
  d.source("Table 1");  // the other tables have no modulus of rings
  d.numbers("ring's Young's modulus", "Pa", of_each(rings, &Ring::youngs_modulus), 70e9);
  d.numbers("ring's Poisson's ratio", "", of_each(rings, &Ring::poissons_ratio), 0.33);
}

double laid_length(const Thread& thread) {
  double length = 0;
  for (std::size_t i = 1; i < thread.points.size(); ++i)
    length += (thread.points[i] - thread.points[i - 1]).norm();
  return length;
}

Vec3 velocity_of(const NodeSpec& node, const Vec3& of_part) { return node.velocity.value_or(of_part); }

// Sec. 5.1: a ball on a thread through a ring that slides along Y.
void compare_ring_pull(const Scene& s, Differences& d) {
  const Thread& thread = s.threads[0];
  const Ring& ring = s.rings[0];
  d.source("Sec. 5.1");
  d.number("ball's mass", "kg", thread.start.mass, 0.1);
  d.vector("ball's velocity", "m/s", velocity_of(thread.start, thread.velocity), {0, 0, -1});
  d.vector("thread's velocity", "m/s", thread.velocity, Vec3::Zero());
  d.vector("gravity", "m/s^2", s.gravity.value_or(Vec3::Zero()), Vec3::Zero());
  d.vector("ball's place", "m", thread.points.front(), {0, -0.2, 0});
  d.vector("place of the thread's end", "m", thread.points.back(), {0, 0.8, 0});
  d.number("thread as laid", "m", laid_length(thread), 1);
  d.number("thread's length", "m", thread.length > 0 ? thread.length : laid_length(thread), 1);
  d.fact("thread held at its end alone", thread.end.support == Support::fixed &&
                                             thread.start.support == Support::free && thread.nodes.empty());
  d.vector("ring's place", "m", ring.center, Vec3::Zero());
  d.vector("ring's velocity", "m/s", ring.velocity, Vec3::Zero());
  d.fact("ring guided along Y", ring.support == Support::guided && std::abs(ring.axis.y()) > 1 - kTolerance);
  d.fact("ring's plane at right angles to Y", std::abs(ring.normal.y()) > 1 - kTolerance);
  d.source("Table 1");
  d.number("thread's diameter", "m", thread.diameter, 0.002);
  compare_material("thread's", s.materials.at(thread.material), 1e9, 0.3, 970, d);
  compare_rings(s.rings, 0.02, 0.004, 0.1, d);
}

// Fig. 4: four rings on an edge of ten meshes, the outer ones in its first and last mesh.
void compare_ringed_edge(const Scene& s, const std::string& edge, Differences& d) {
  int count = 0, first = s.nets[0].columns(), last = 0;
  for (const Ring& ring : s.rings) {
    if (ring.host != RingHost::element || ring.element_of != "net." + s.nets[0].name + "." + edge) continue;
    const int mesh = ring.element / s.nets[0].elements_per_side;
    ++count, first = std::min(first, mesh), last = std::max(last, mesh);
  }
  d.source("Fig. 4");
  d.number("rings on the net's " + edge + " edge", "", count, 4);
  d.number("meshes between its outer rings", "", last - first, 9);
}

void compare_net(const Net& net, Differences& d) {
  d.number("net's width", "m", net.width, 1);
  d.number("net's height", "m", net.height, 1);
  d.number("net's mesh", "m", net.mesh, 0.1);
  d.number("diameter of the net's threads", "m", net.diameter, 0.002);
}

bool hangs_by_upper_corners(const Net& net) {
  const auto fixed = [&](const char* corner) {
    const auto found = net.nodes.find(corner);
    return found != net.nodes.end() && found->second.support == Support::fixed;
  };
  return net.nodes.size() == 2 && fixed("top_left") && fixed("top_right");
}

// Sec. 5.2: two falling masses close the lower edge of a hanging net.
void compare_edge_closure(const Scene& s, Differences& d) {
  const Net& net = s.nets[0];
  const Thread& thread = s.threads[0];
  d.source("Table 2");
  compare_net(net, d);
  compare_material("net's", s.materials.at(net.material), 87e9, 0.35, 650, d);
  d.numbers("mass on the thread", "kg", {thread.start.mass, thread.end.mass}, 0.1);
  const double laid = net.width + thread.overhang_start + thread.overhang_end;
  d.number("closing thread's length", "m", thread.length > 0 ? thread.length : laid, {1.19, 1.21});
  d.number("closing thread's diameter", "m", thread.diameter, 0.002);
  const Material& closing = s.materials.at(thread.material);  // Table 1 and Sec. 5.3 against Table 2
  d.number("closing thread's Young's modulus", "Pa", closing.youngs_modulus, {1e9, 87e9});
  d.number("closing thread's Poisson's ratio", "", closing.poissons_ratio, {0.3, 0.35});
  d.number("closing thread's density", "kg/m^3", closing.density, 650);
  compare_rings(s.rings, 0.014, 0.002, 0.001, d);
  d.source("Sec. 5.2");
  d.number("right mass, from the middle of the edge", "m", net.width / 2 + thread.overhang_start, 0.615);
  d.number("left mass, from the middle of the edge", "m", net.width / 2 + thread.overhang_end, 0.585);
  d.vector("gravity", "m/s^2", s.gravity.value_or(Vec3::Zero()), {0, 0, -9.81});
  d.fact("upright net", (net.y_axis - Vec3::UnitZ()).norm() < kTolerance);
  d.fact("net hanging by its upper corners", hangs_by_upper_corners(net));
  d.fact("start at rest, in equilibrium", s.equilibrium && net.velocity.isZero());
  d.fact("masses that begin at rest",
         velocity_of(thread.start, Vec3::Zero()).isZero() && velocity_of(thread.end, Vec3::Zero()).isZero());
  d.fact("thread with nothing but its two free masses", thread.start.support == Support::free &&
                                                            thread.end.support == Support::free &&
                                                            thread.nodes.empty());
  d.number("closing time", "s", s.closing.time.value_or(std::nan("")), 0);
  compare_ringed_edge(s, "bottom", d);
}

// Table 3: what split mass a gains at a corner; b gains the opposite.
Vec3 separation(const std::string& corner) {
  const bool top = corner.find(".top_") != std::string::npos, right = corner.ends_with("right");
  return {top ? -2.0 : 2.0, right ? 2.0 : -2.0, 0};
}

void compare_mechanisms(const std::vector<Mechanism>& all, Differences& d) {
  const auto speed = [](const Mechanism& m) { return m.launch_velocity.norm(); };
  const auto angle = [&](const Mechanism& m) {
    return std::acos(m.launch_velocity.z() / speed(m)) * 180 / std::numbers::pi;
  };
  d.source("Sec. 5.3");
  d.numbers("launcher's mass", "kg", of_each(all, &Mechanism::launcher_mass), 0.05);
  d.numbers("split mass", "kg", of_each(all, &Mechanism::split_mass), 0.1);
  d.numbers("launch speed", "m/s", of_each(all, speed), 1);
  d.numbers("angle between launch and Z", "deg", of_each(all, angle), 35);
  d.source("Table 3");
  for (const Mechanism& m : all) {
    d.vector("separation of mass a of " + m.name, "m/s", m.separation_a, separation(m.corner));
    d.vector("separation of mass b of " + m.name, "m/s", m.separation_b, -separation(m.corner));
  }
}

bool bare(const Scene& s) {
  return s.nets[0].nodes.empty() && std::all_of(s.threads.begin(), s.threads.end(), [](const Thread& t) {
           return t.nodes.empty() && t.start.mass == 0 && t.end.mass == 0 && t.start.on.ends_with(".b") &&
                  t.end.on.ends_with(".a");
         });
}

void compare_closing_threads(const Scene& s, Differences& d) {
  const auto material = [&](const Thread& t) { return s.materials.at(t.material); };
  const auto overhang = [](const Thread& t) { return t.overhang_start + t.overhang_end; };
  d.source("Sec. 5.3");
  // how much longer than its way a thread is, is open: slack of some millimetres
  d.numbers("closing thread's length", "m", of_each(s.threads, &Thread::length), {1.19, 1.21});
  d.numbers("closing thread's overhang", "m", of_each(s.threads, overhang), 0);
  d.fact("closing threads from split mass to split mass and nothing else", bare(s));
  d.source("Table 1");
  d.numbers("closing thread's diameter", "m", of_each(s.threads, &Thread::diameter), 0.002);
  const auto modulus = [&](const Thread& t) { return material(t).youngs_modulus; };
  const auto density = [&](const Thread& t) { return material(t).density; };
  d.numbers("closing thread's Young's modulus", "Pa", of_each(s.threads, modulus), {1e9, 87e9});
  d.numbers("closing thread's density", "kg/m^3", of_each(s.threads, density), 970);
}

// Sec. 5.3: a net is launched, meets a ball and closes round it; Fig. 14: at other closing times.
void compare_capture(const Scene& s, Differences& d) {
  const Net& net = s.nets[0];
  const BallTarget& ball = s.targets[0];
  d.source("Table 4");
  compare_net(net, d);
  compare_material("net's", s.materials.at(net.material), 87e9, 0.35, 970, d);
  d.number("target's radius", "m", ball.radius, 0.15);
  d.number("target's Young's modulus", "Pa", ball.youngs_modulus, 2.3e9);
  d.number("target's Poisson's ratio", "", ball.poissons_ratio, 0.39);
  compare_rings(s.rings, 0.02, 0.004, 0.006, d);
  d.source("Sec. 5.3");
  d.vector("target's place", "m", ball.center, {0, 0, 1});
  d.vector("net's place", "m", net.center, Vec3::Zero());
  d.vector("net's velocity", "m/s", net.velocity, Vec3::Zero());
  d.vector("gravity", "m/s^2", s.gravity.value_or(Vec3::Zero()), Vec3::Zero());
  d.fact("net with its edges along X and Y", (net.x_axis - Vec3::UnitX()).norm() < kTolerance &&
                                                 (net.y_axis - Vec3::UnitY()).norm() < kTolerance);
  compare_mechanisms(s.mechanisms, d);
  compare_closing_threads(s, d);
  d.source("Fig. 14");
  d.number("closing time", "s", s.closing.time.value_or(std::nan("")), {1.2, 1.6});
  for (const char* edge : {"top", "right", "bottom", "left"}) compare_ringed_edge(s, edge, d);
}

struct Candidate {
  PaperCase as;
  std::size_t nets, mechanisms, threads, rings, targets;
  bool closing;
  void (*compare)(const Scene&, Differences&);
};

constexpr Candidate kCandidates[] = {
    {PaperCase::ring_pull, 0, 0, 1, 1, 0, false, compare_ring_pull},
    {PaperCase::edge_closure, 1, 0, 1, 4, 0, true, compare_edge_closure},
    {PaperCase::capture, 1, 4, 4, 16, 1, true, compare_capture},
};

bool same_parts(const Scene& s, const Candidate& c) {
  return s.nets.size() == c.nets && s.mechanisms.size() == c.mechanisms && s.threads.size() == c.threads &&
         s.rings.size() == c.rings && s.targets.size() == c.targets &&
         std::all_of(s.threads.begin(), s.threads.end(),
                     [&](const Thread& t) { return t.closing() == c.closing; });
}

}  // namespace

Recognised recognise(const Scene& scene) {
  for (const Candidate& candidate : kCandidates) {
    if (!same_parts(scene, candidate)) continue;
    Differences differences;
    candidate.compare(scene, differences);
    const std::string text = differences.text();
    return {text.empty() ? candidate.as : PaperCase::none, text};
  }
  return {};
}

}  // namespace cinch
