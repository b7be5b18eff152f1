// The store: masses lumped at nodes, models of both phases; and what is measured on the net's shape, the
// mouth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "input/case_reader.hpp"
#include "scene/mouth.hpp"
#include "scene/net_pattern.hpp"
#include "store/model.hpp"

namespace {

using namespace cinch;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Scene read(const std::string& name, const std::vector<Override>& sets = {}) {
  return read_case(std::string(CINCH_SOURCE_DIR) + "/cases/" + name + ".toml", sets);
}

Net net_of(int columns, int rows, int sub) {
  Net net;
  net.mesh = 0.1;
  net.width = 0.1 * columns;
  net.height = 0.1 * rows;
  net.elements_per_side = sub;
  return net;
}

// ----------------------------------------------------------------------------------------------------
// Numbering of nets

// Of every side (horizontal or vertical, mesh, element) the node must lie where it belongs.
void expect_nodes_in_their_places(const Net& net) {
  const NetPattern pattern(net);
  std::vector<std::array<double, 2>> place;
  pattern.for_each_node([&](double x, double y) { place.push_back({x, y}); });
  ASSERT_EQ(place.size(), at(pattern.nodes()));
  std::vector<int> met(place.size(), 0);
  const auto check = [&](Index node, double x, double y) {
    ASSERT_TRUE(node >= 0 && node < pattern.nodes());
    ++met[at(node)];
    ASSERT_NEAR(place[at(node)][0], x * net.mesh - 0.5 * net.width, 1e-9);
    ASSERT_NEAR(place[at(node)][1], y * net.mesh - 0.5 * net.height, 1e-9);
  };
  const Index sub = net.elements_per_side;
  for (Index j = 0; j <= net.rows(); ++j)
    for (Index i = 0; i <= net.columns(); ++i) {
      check(pattern.knot(i, j), i, j);
      for (Index k = 1; k < sub; ++k) {
        const double part = static_cast<double>(k) / sub;
        if (i < net.columns()) check(pattern.horizontal(i, j, k), i + part, j);
        if (j < net.rows()) check(pattern.vertical(i, j, k), i, j + part);
      }
    }
  EXPECT_EQ(met, std::vector<int>(place.size(), 1));
}

TEST(NetPattern, NumbersEachNodeOnceAndInItsPlace) {
  for (const auto& [columns, rows, sub] :
       {std::array{1, 1, 1}, {3, 2, 1}, {10, 10, 2}, {10, 10, 4}, {1, 200, 3}, {7, 100, 5}, {300, 4, 4}}) {
    SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows) + ", " + std::to_string(sub));
    expect_nodes_in_their_places(net_of(columns, rows, sub));
  }
}

// ----------------------------------------------------------------------------------------------------
// Masses

// Capture, by hand. Elements of the net and towing threads: 970 kg/m^3 pi/4 (2 mm)^2 0.1 m = 3.047344874e-4
// kg, of the closing threads (5 mm): 1.523672437e-5 kg. A ring gives 0.003 kg to each end of its host, eq.
// (2).
constexpr double net_element = 3.047344874e-4, closing_element = 1.523672437e-5;

TEST(Masses, OfCaptureByEquation2) {
  const Assembly a = assemble(read("capture"));
  const Part& net = a.parts.front();
  const auto mass = [&](const char* place) { return a.nodes[at(a.node_in_net(net, place))].mass; };
  constexpr double tolerance = 1e-12;
  // four sides meet inside; on an edge three; in a corner two and the towing thread
  EXPECT_NEAR(mass("knot.5.5"), 2 * net_element, tolerance);
  // edge: cells 1, 4, 7, 10 carry rings: knots 2 and 5 have none or one beside them
  EXPECT_NEAR(mass("knot.2.10"), 1.5 * net_element, tolerance);
  EXPECT_NEAR(mass("knot.3.10"), 1.5 * net_element + 0.003, tolerance);
  EXPECT_NEAR(mass("knot.1.10"), 1.5 * net_element + 0.003, tolerance);
  EXPECT_NEAR(mass("knot.0.5"), 1.5 * net_element, tolerance);
  // a corner lies between the last ring of one edge and the first of the next
  EXPECT_NEAR(mass("top_left"), 1.5 * net_element + 2 * 0.003, tolerance);
  EXPECT_NEAR(mass("bottom_right"), 1.5 * net_element + 2 * 0.003, tolerance);
  // launcher: 0.05 kg and half the towing thread; split masses: 0.1 kg and half a closing element
  EXPECT_NEAR(a.nodes[at(a.node_of("mechanism.m3.launcher"))].mass, 0.05 + net_element / 2, tolerance);
  EXPECT_NEAR(a.nodes[at(a.node_of("mechanism.m3.a"))].mass, 0.1 + closing_element / 2, tolerance);
  EXPECT_NEAR(a.nodes[at(a.node_of("mechanism.m3.b"))].mass, 0.1 + closing_element / 2, tolerance);
  EXPECT_NEAR(a.nodes[at(a.node_of("thread.c_top.node.100"))].mass, closing_element, tolerance);
}

TEST(Masses, BeforeTheClosingTimeByHand) {
  const Assembly a = assemble(read("capture"));
  const Part& net = a.parts.front();
  const auto before = [&](const std::string& place) {
    return a.nodes[at(a.node_in_net(net, place))].mass_before;
  };
  // along an edge each side of 0.1 m carries 20 closing elements, shared like the side's own mass
  const double on_side = 20 * closing_element;
  EXPECT_NEAR(before("knot.5.5"), 2 * net_element, 1e-12);
  EXPECT_NEAR(before("knot.2.10"), 1.5 * net_element + on_side, 1e-12);
  // a corner and a launcher belong to two closing threads
  EXPECT_NEAR(before("top_left"), 1.5 * net_element + 0.006 + 2 * on_side, 1e-12);
  EXPECT_NEAR(a.nodes[at(a.node_of("mechanism.m1.launcher"))].mass_before, 0.25 + net_element / 2 + on_side,
              1e-12);
  EXPECT_EQ(a.nodes[at(a.node_of("mechanism.m1.a"))].mass_before, 0);
}

Scene capture_with_threads_of(int elements) {
  Scene scene = read("capture");
  for (Thread& thread : scene.threads) thread.elements = elements;
  return scene;
}

// An element between two towing threads' ends has no node that could take up what lies between.
TEST(Masses, BeforeTheClosingTimeThreadsOfAnyNumberOfElementsLoadANetAlike) {
  const Assembly fine = assemble(read("capture"));
  for (const LaidThread& laid : fine.laid) EXPECT_TRUE(laid.excess.empty());
  for (const int elements : {1, 2, 3, 5, 7, 8, 11, 12, 13, 36, 100}) {
    SCOPED_TRACE(elements);
    const Assembly a = assemble(capture_with_threads_of(elements));
    for (Index i = 0; elements > 1 && i < a.nodes_before; ++i)
      EXPECT_NEAR(a.nodes[at(i)].mass_before, fine.nodes[at(i)].mass_before, 1e-14);
    ASSERT_EQ(a.laid.size(), 4u);
    for (const LaidThread& laid : a.laid) {
      EXPECT_NEAR(laid.mass, 240 * closing_element, 1e-13);
      EXPECT_EQ(laid.excess.empty(), elements == 1 || elements % 12 == 0);
      double sum = 0;
      for (const Load& load : laid.excess) sum += load.mass;
      EXPECT_NEAR(sum, 0, 1e-17);
    }
  }
}

// Ends on the net, and what lies beyond the carrier; without the thread the net weighs what it weighs.
TEST(Masses, BeforeTheClosingTimeWithOverhangsAndSharedNodes) {
  Scene scene = read("capture");
  scene.threads.resize(1);
  Thread& thread = scene.threads.front();
  thread.along = {"net.main.top"};
  thread.start = thread.end = {};
  thread.length = 0;
  Scene bare = scene;
  bare.threads.clear();
  const Assembly net = assemble(bare);
  const auto metres = [&](const Assembly& a, const std::string& place) {  // of thread on a knot
    const Index knot = a.node_of("net.main." + place);
    return (a.nodes[at(knot)].mass_before - net.nodes[at(knot)].mass_before) / (200 * closing_element);
  };
  thread.elements = 3;
  thread.overhang_start = 0.03, thread.overhang_end = 0.07;
  const Assembly over = assemble(scene);
  EXPECT_NEAR(metres(over, "top_left"), 0.05 + 0.03, 1e-9);
  EXPECT_NEAR(metres(over, "knot.4.10"), 0.1, 1e-9);
  EXPECT_NEAR(metres(over, "top_right"), 0.05 + 0.07, 1e-9);
  thread.elements = 2;
  thread.overhang_start = thread.overhang_end = 0;
  thread.start.on = "net.main.top_left", thread.end.on = "net.main.top_right";
  const Assembly shared = assemble(scene);
  EXPECT_NEAR(metres(shared, "top_left"), 0.05, 1e-9);
  EXPECT_NEAR(metres(shared, "knot.4.10"), 0.1, 1e-9);
  const Index corner = shared.node_of("net.main.top_left");
  EXPECT_NEAR((shared.nodes[at(corner)].mass - net.nodes[at(corner)].mass) / (200 * closing_element), 0.25,
              1e-9)
      << "half an element from the closing time on";
}

TEST(Masses, OfAThreadAndARing) {
  const Assembly a = assemble(read("ring_pull"));
  // 970 kg/m^3 pi/4 (2 mm)^2 5 mm
  EXPECT_NEAR(a.nodes.front().mass, 0.1 + closing_element / 2, 1e-14);
  EXPECT_NEAR(a.nodes[1].mass, closing_element, 1e-14);
  EXPECT_NEAR(a.nodes[200].mass, closing_element / 2, 1e-14);
  EXPECT_EQ(a.nodes[201].mass, 0.1);
}

TEST(Masses, TotalsAgreeBeforeAndAfter) {
  const struct {
    const char* name;
    double total;  // kg: threads, net, rings, masses
  } cases[] = {
      {"capture", 220 * net_element + 4 * net_element + 960 * closing_element + 16 * 0.006 + 4 * 0.25},
      {"edge_closure", (220 * net_element + 240 * closing_element) * 650 / 970 + 4 * 0.001 + 0.2},
      {"ring_pull", 200 * closing_element + 0.1 + 0.1}};
  for (const auto& item : cases) {
    SCOPED_TRACE(item.name);
    const Scene scene = read(item.name);
    const Assembly a = assemble(scene);
    double before = 0, after = 0;
    for (const AssemblyNode& node : a.nodes) before += node.mass_before, after += node.mass;
    EXPECT_NEAR(after, item.total, 1e-10);
    EXPECT_NEAR(before, after, 1e-14 * static_cast<double>(a.nodes.size()));
    const Model model_before = build_model(a, scene, Stage::before_closing),
                model = build_model(a, scene, Stage::closing);
    EXPECT_NEAR(std::accumulate(model_before.mass.begin(), model_before.mass.end(), 0.0), item.total, 1e-10);
    EXPECT_NEAR(std::accumulate(model.mass.begin(), model.mass.end(), 0.0), item.total, 1e-10);
  }
}

// ----------------------------------------------------------------------------------------------------
// Models

TEST(Models, CountNodesAndElements) {
  const struct {
    const char* name;
    Index nodes, elements, nodes_before, elements_before;
    std::size_t rings;
  } cases[] = {
      {"ring_pull", 202, 200, 202, 200, 1},
      {"edge_closure", 121 + 241, 220 + 240, 121, 220, 4},
      // 11 x 11 knots and 4 launchers; 8 split masses and 4 x 239 thread nodes
      {"capture", 125 + 8 + 4 * 239, 224 + 4 * 240, 125, 224, 16},
      // 201 x 201 knots and 4 x 20 towing nodes; 8 split masses and 4 x 4799 thread nodes
      {"large_capture", 201 * 201 + 80 + 8 + 4 * 4799, 2 * 200 * 201 + 80 + 4 * 4800, 201 * 201 + 80,
       2 * 200 * 201 + 80, 800},
  };
  for (const auto& item : cases) {
    SCOPED_TRACE(item.name);
    const Scene scene = read(item.name);
    const Assembly a = assemble(scene);
    const Model before = build_model(a, scene, Stage::before_closing),
                after = build_model(a, scene, Stage::closing);
    EXPECT_EQ(after.nodes, item.nodes);
    EXPECT_EQ(after.elements, item.elements);
    EXPECT_EQ(after.rings.size(), item.rings);
    EXPECT_EQ(before.nodes, item.nodes_before);
    EXPECT_EQ(before.elements, item.elements_before);
    EXPECT_EQ(before.rings.size(), a.has_closing() ? 0u : item.rings);
  }
}

TEST(Models, KeepEveryElementsNumbers) {
  const Scene scene = read("capture");
  const Assembly a = assemble(scene);
  const Model m = build_model(a, scene, Stage::closing);
  for (std::size_t e = 0; e < at(m.elements); ++e) {
    const AssemblyElement& user = a.elements[e];
    ASSERT_EQ(m.end_a[e], user.a);
    ASSERT_EQ(m.end_b[e], user.b);
    ASSERT_EQ(m.stiffness[e], user.stiffness);
    ASSERT_EQ(m.damping[e], user.damping);
    ASSERT_EQ(m.rest_length[e], user.rest_length);
    ASSERT_EQ(m.radius[e], user.radius);
    ASSERT_EQ(m.compliance[e], user.compliance);
  }
  // 87 GPa pi/4 (2 mm)^2 / 0.1 m; c = 2 0.106 sqrt(k m)
  EXPECT_NEAR(a.elements.front().stiffness, 2.733185609e6, 1e-3);
  EXPECT_NEAR(a.elements.front().damping, 2 * 0.106 * std::sqrt(2.733185609e6 * net_element), 1e-7);
}

TEST(Models, ContactSetsShareNodesOut) {
  const Scene scene = read("capture");
  const Assembly a = assemble(scene);
  const Model m = build_model(a, scene, Stage::closing);
  ASSERT_EQ(m.contact_sets.size(), 2u) << "all rings share one set, the ball has another";
  const ContactSet& threads = m.contact_sets[at(m.ring_set.front())];
  EXPECT_EQ(threads.elements.size(), 960u);
  EXPECT_TRUE(std::is_sorted(threads.elements.begin(), threads.elements.end()));
  for (std::size_t i = 0; i < threads.elements.size(); ++i) {
    const Index e = threads.elements[i];
    const auto of = [&](Index node) {
      for (const Lay& lay : a.lays)
        if (lay.node == node && lay.jump != Vec3::Zero()) return 1.0;
      return 0.5;
    };
    ASSERT_EQ(threads.fraction_a[i], of(m.end_a[at(e)]))
        << "a split mass ends one thread, inside two elements meet";
    ASSERT_EQ(threads.fraction_b[i], of(m.end_b[at(e)]));
  }
  const Model as_paper = build_model(a, read("capture", {{"contact.shared_node", "paper"}}), Stage::closing);
  for (const double fraction : as_paper.contact_sets.front().fraction_a) ASSERT_EQ(fraction, 0);
}

// ----------------------------------------------------------------------------------------------------
// The mouth

// A point of the plane through (1, 2, 3) spanned by two tilted unit vectors.
Vec3 tilted(double u, double v) {
  const Vec3 e1 = Vec3(1, 2, 2) / 3, e2 = Vec3(2, 1, -2) / 3;
  return Vec3(1, 2, 3) + u * e1 + v * e2;
}

TEST(Mouth, AreaOfKnownShapes) {
  EXPECT_EQ(mouth_area({}), 0);
  EXPECT_EQ(mouth_area({tilted(0, 0), tilted(1, 0)}), 0);
  EXPECT_NEAR(mouth_area({tilted(0, 0), tilted(3, 0), tilted(0, 4)}), 6, 1e-12);
  EXPECT_NEAR(mouth_area({tilted(0, 0), tilted(2, 0), tilted(2, 3), tilted(0, 3)}), 6, 1e-12);
  // points inside and on the sides do not count, nor does the order
  EXPECT_NEAR(
      mouth_area({tilted(2, 3), tilted(1, 1), tilted(0, 0), tilted(1, 0), tilted(0, 3), tilted(2, 0)}), 6,
      1e-12);
  EXPECT_NEAR(mouth_area({tilted(0, 0), tilted(1, 1), tilted(2, 2), tilted(3, 3)}), 0, 1e-12);
  std::vector<Vec3> ring;
  for (int k = 0; k < 16; ++k)
    ring.push_back(tilted(std::cos(k * std::numbers::pi / 8), std::sin(k * std::numbers::pi / 8)));
  EXPECT_NEAR(mouth_area(ring), 8 * std::sin(std::numbers::pi / 8), 1e-12);
}

TEST(Mouth, AreaIsTakenOnTheBestPlane) {
  // corners lifted by turns off the plane of a square of side 2: the best plane is that of the square
  EXPECT_NEAR(mouth_area({{-1, -1, 0.1}, {1, -1, -0.1}, {1, 1, 0.1}, {-1, 1, -0.1}}), 4, 1e-12);
}

TEST(Mouth, SpreadIsTheGreatestDistance) {
  EXPECT_EQ(mouth_spread({}), 0);
  EXPECT_EQ(mouth_spread({tilted(1, 1)}), 0);
  EXPECT_NEAR(mouth_spread({tilted(0, 0), tilted(1, 0), tilted(3, 4), tilted(1, 1)}), 5, 1e-12);
}

// A net of 12 x 12 meshes laid on the unit sphere about the origin, from the pole at +Z down to `opening`
// radians from the other pole: 0 closes the bag.
std::vector<Vec3> bag(const Net& net, double opening) {
  std::vector<Vec3> list;
  NetPattern(net).for_each_node([&](double x, double y) {
    const double half = net.width / 2, u = x / half, v = y / half;
    const double out = std::max(std::abs(u), std::abs(v));  // 0 in the middle, 1 on the edge
    const double polar = out * (std::numbers::pi - opening), turn = std::atan2(v, u);
    list.emplace_back(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
  });
  return list;
}

TEST(Mouth, ABagEnclosesWhatIsInside) {
  const Net net = net_of(12, 12, 1);
  const NetSurface surface(net, 0);
  for (const double opening : {0.05, 0.5, 1.5}) {  // the lid lies at z = -cos(opening)
    SCOPED_TRACE(opening);
    const std::vector<Vec3> x = bag(net, opening);
    EXPECT_TRUE(surface.encloses(x, {0, 0, 0.5}));
    EXPECT_TRUE(surface.encloses(x, {0.3, -0.3, 0.2}));
    EXPECT_TRUE(surface.encloses(x, {0, 0, -std::cos(opening) + 0.02}));
    EXPECT_FALSE(surface.encloses(x, {0, 0, -std::cos(opening) - 0.02})) << "in front of the mouth";
    EXPECT_FALSE(surface.encloses(x, {0, 0, 1.2}));
    EXPECT_FALSE(surface.encloses(x, {1.1, 0, 0}));
    EXPECT_FALSE(surface.encloses(x, {0, 3, -4}));
  }
}

TEST(Mouth, AFlatNetEnclosesNothing) {
  const Net net = net_of(12, 12, 2);
  const NetSurface surface(net, 0);
  std::vector<Vec3> points;
  NetPattern(net).for_each_node([&](double x, double y) { points.emplace_back(x, y, 0); });
  for (const double z : {-1.0, -0.01, 0.01, 1.0}) EXPECT_FALSE(surface.encloses(points, {0.01, 0.02, z}));
}

TEST(Mouth, ANetThatIsNotTheFirstPartCountsFromItsFirstNode) {
  const Net net = net_of(12, 12, 1);
  std::vector<Vec3> x(50, Vec3(9, 9, 9));
  for (const Vec3& point : bag(net, 0.5)) x.push_back(point);
  EXPECT_TRUE(NetSurface(net, 50).encloses(x, {0, 0, 0}));
  EXPECT_FALSE(NetSurface(net, 0).encloses(x, {0, 0, 0}));
}

}  // namespace
