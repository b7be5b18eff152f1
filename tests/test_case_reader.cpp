// Case files: what is read, what is refused and with which words.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "base/error.hpp"
#include "input/case_reader.hpp"

namespace cinch {
namespace {

namespace fs = std::filesystem;

const fs::path source_dir = CINCH_SOURCE_DIR;
const std::vector<std::string> case_names = {"ring_pull", "edge_closure", "capture", "large_capture"};

const std::string head = "schema = 1\n[time]\nend_s = 1\n";
const std::string aramid = "[material.aramid]\nyoungs_modulus_Pa = 1e9\ndensity_kg_m3 = 970\n";
const std::string thread =
    "[thread.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nelements = 10\npoints_m = [[0, 0, 0], [1, 0, "
    "0]]\n";
const std::string net =
    "[net.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nsize_m = [1, 1]\nmesh_m = 0.1\n";
const std::string ring_body =
    "diameter_m = 0.02\nwire_diameter_m = 0.004\nmass_kg = 0.01\nyoungs_modulus_Pa = 70e9\n";
const std::string mechanism =
    "[mechanism.m1]\ncorner = \"net.main.top_left\"\nlauncher_mass_kg = 0.05\nsplit_mass_kg = 0.1\n"
    "towing_material = \"aramid\"\ntowing_diameter_m = 0.002\nseparation_a_m_s = [-2, -2, 0]\n"
    "separation_b_m_s = [2, 2, 0]\n";
const std::string minimal = head + aramid + thread;

std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_case(text, "t.toml", overrides);
  } catch (const CaseError& error) {
    EXPECT_EQ(error.code, ExitCode::usage);
    return error.what();
  }
  return "";
}

// Every piece must stand in the error.
void expect_error(const std::string& text, const std::vector<std::string>& pieces,
                  const std::vector<Override>& overrides = {}) {
  const std::string error = error_of(text, overrides);
  for (const std::string& piece : pieces)
    EXPECT_NE(error.find(piece), std::string::npos) << "missing: " << piece << "\nin: " << error;
}

std::size_t count_errors(const std::string& error) {
  std::size_t count = 0;
  for (std::size_t at = error.find(": error: "); at != std::string::npos;
       at = error.find(": error: ", at + 1))
    ++count;
  return count;
}

std::string read_file(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// ---- cases
// -----------------------------------------------------------------------------------------------------

TEST(CaseReader, ReadsAllCasesAndTheirResolvedText) {
  for (const std::string& name : case_names) {
    SCOPED_TRACE(name);
    const Scene scene = read_case(source_dir / "cases" / (name + ".toml"));
    EXPECT_EQ(scene.name, name);
    EXPECT_FALSE(scene.title.empty());
    EXPECT_NE(scene.about.find("Expect"), std::string::npos);
    const Scene again = parse_case(scene.resolved_toml, name + ".toml");
    EXPECT_EQ(again.resolved_toml, scene.resolved_toml);
    EXPECT_EQ(again.rings.size(), scene.rings.size());
    EXPECT_EQ(again.threads.size(), scene.threads.size());
  }
}

TEST(CaseReader, RingPullIsTheSceneOfTable1) {
  const Scene scene = read_case(source_dir / "cases/ring_pull.toml");
  ASSERT_EQ(scene.threads.size(), 1u);
  const Thread& main = scene.threads[0];
  EXPECT_EQ(main.elements, 200);
  EXPECT_EQ(main.points.front(), Vec3(0, -0.2, 0));
  EXPECT_EQ(main.start.mass, 0.1);
  EXPECT_EQ(*main.start.velocity, Vec3(0, 0, -1));
  EXPECT_EQ(main.end.support, Support::fixed);
  EXPECT_FALSE(main.end.velocity);
  ASSERT_EQ(scene.rings.size(), 1u);
  EXPECT_EQ(scene.rings[0].host, RingHost::node);
  EXPECT_EQ(scene.rings[0].support, Support::guided);
  EXPECT_EQ(scene.rings[0].axis, Vec3(0, 1, 0));
  EXPECT_EQ(scene.materials.at("thread").damping_ratio, 0.106);
  EXPECT_EQ(scene.time.step, 1e-6);
  EXPECT_FALSE(scene.gravity);
  EXPECT_FALSE(scene.closing.time);
}

TEST(CaseReader, EdgeClosureHasTheMeasuredOverhangs) {
  const Scene scene = read_case(source_dir / "cases/edge_closure.toml");
  const Thread& closing = scene.threads.at(0);
  EXPECT_TRUE(closing.closing());
  EXPECT_NEAR(closing.overhang_start + 0.5, 0.615, 1e-12);  // right mass: the edge runs from right to left
  EXPECT_NEAR(closing.overhang_end + 0.5, 0.585, 1e-12);
  EXPECT_EQ(*scene.gravity, Vec3(0, 0, -9.81));
  EXPECT_TRUE(scene.equilibrium);
  EXPECT_EQ(*scene.closing.time, 0);
  ASSERT_EQ(scene.rings.size(), 4u);
  EXPECT_EQ(scene.rings[3].element_of, "net.main.bottom");
  EXPECT_EQ(scene.rings[3].element, 9);
}

TEST(CaseReader, CaptureFollowsTable3) {
  const Scene scene = read_case(source_dir / "cases/capture.toml");
  ASSERT_EQ(scene.mechanisms.size(), 4u);
  const double angle = 35 * std::numbers::pi / 180, across = std::sin(angle) / std::sqrt(2);
  EXPECT_LT((scene.mechanisms[0].launch_velocity - Vec3(-across, across, std::cos(angle))).norm(), 1e-14);
  EXPECT_LT((scene.mechanisms[2].launch_velocity - Vec3(across, -across, std::cos(angle))).norm(), 1e-14);
  EXPECT_EQ(scene.mechanisms[0].initial_stretch, 0.1);
  for (const Mechanism& m : scene.mechanisms) EXPECT_EQ(m.separation_a, -m.separation_b);
  ASSERT_EQ(scene.rings.size(), 16u);
  EXPECT_EQ(scene.rings[0].name, "r1");
  EXPECT_EQ(scene.rings[0].element_of, "net.main.top");
  EXPECT_EQ(scene.rings[15].name, "r16");
  EXPECT_EQ(scene.rings[15].element_of, "net.main.left");
  EXPECT_EQ(scene.rings[15].element, 9);  // beside mechanism 1
  EXPECT_EQ(scene.probes.front().name, "force_r1");
}

// A split mass moves inwards along the edge of its own thread and outwards across it.
TEST(CaseReader, CaptureSplitMassesPullTheirOwnThreads) {
  const Scene scene = read_case(source_dir / "cases/capture.toml");
  const std::map<std::string, Vec3> outwards = {
      {"top", {0, 1, 0}}, {"right", {1, 0, 0}}, {"bottom", {0, -1, 0}}, {"left", {-1, 0, 0}}};
  for (const Thread& t : scene.threads) {
    SCOPED_TRACE(t.name);
    const Vec3 out = outwards.at(t.along.at(1).substr(9));
    const Vec3 forward(out.y(), -out.x(), 0);  // clockwise
    const auto separation = [&](const std::string& on) {
      for (const Mechanism& m : scene.mechanisms)
        if (on.substr(10, m.name.size()) == m.name) return on.back() == 'a' ? m.separation_a : m.separation_b;
      return Vec3(0, 0, 0);
    };
    EXPECT_GT(separation(t.start.on).dot(out), 0);
    EXPECT_GT(separation(t.start.on).dot(forward), 0);
    EXPECT_GT(separation(t.end.on).dot(out), 0);
    EXPECT_LT(separation(t.end.on).dot(forward), 0);
  }
}

TEST(CaseReader, LargeCaptureIsLarge) {
  const Scene scene = read_case(source_dir / "cases/large_capture.toml");
  EXPECT_GE(scene.rings.size(), 600u);
  int closing_elements = 0;
  for (const Thread& t : scene.threads) closing_elements += t.elements;
  EXPECT_GE(closing_elements, 19000);
  EXPECT_NEAR(scene.threads[0].length / scene.threads[0].elements, 0.005, 1e-12);
  EXPECT_EQ(scene.time.step, 0);  // auto
}

TEST(CaseReader, ReferenceOfTheKeysIsUpToDate) {
  const fs::path file = source_dir / "cases/README.md";
  const std::string mark = "<!-- all keys -->\n\n", text = read_file(file);
  const std::size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos);
  const std::string introduction = text.substr(0, at + mark.size());
  if (std::getenv("CINCH_WRITE_REFERENCE")) std::ofstream(file) << introduction << case_reference();
  EXPECT_EQ(read_file(file), introduction + case_reference())
      << "run this test with CINCH_WRITE_REFERENCE=1 to write the tables anew";
}

// ---- defaults and order
// ------------------------------------------------------------------------------------------

TEST(CaseReader, DefaultsAgreeWithTheScene) {
  const Scene scene = parse_case(minimal, "dir/simple.toml");
  EXPECT_EQ(scene.name, "simple");
  const Scene plain;
  EXPECT_EQ(scene.time.safety, plain.time.safety);
  EXPECT_EQ(scene.time.step, plain.time.step);
  EXPECT_EQ(scene.time.speed_limit, plain.time.speed_limit);
  EXPECT_EQ(scene.output.frame_interval, plain.output.frame_interval);
  EXPECT_EQ(scene.output.ledger, plain.output.ledger);
  EXPECT_EQ(scene.contact.alpha_ring, plain.contact.alpha_ring);
  EXPECT_EQ(scene.contact.couple, plain.contact.couple);
  EXPECT_EQ(scene.contact.distance, plain.contact.distance);
  EXPECT_EQ(scene.contact.shared_node, plain.contact.shared_node);
  EXPECT_EQ(scene.materials.at("aramid").poissons_ratio, Material().poissons_ratio);
  EXPECT_EQ(scene.materials.at("aramid").damping_rule, Material().damping_rule);
  EXPECT_EQ(scene.threads[0].source.text, "dir/simple.toml:7:9");
}

TEST(CaseReader, WordsBecomeTheirEnumerators) {
  const Scene scene =
      parse_case(minimal +
                     "[contact]\ncouple = \"paper\"\ndistance = \"golden\"\nshared_node = \"paper\"\n"
                     "[probe.e]\nquantity = \"energy\"\n"
                     "[probe.t]\nquantity = \"tension\"\nof = \"thread.main\"\n",
                 "t.toml");
  EXPECT_EQ(scene.contact.couple, RingCouple::paper);
  EXPECT_EQ(scene.contact.distance, DistanceMethod::golden);
  EXPECT_EQ(scene.contact.shared_node, SharedNode::paper);
  EXPECT_EQ(scene.probes[0].quantity, ProbeQuantity::energy);
  EXPECT_EQ(scene.probes[1].quantity, ProbeQuantity::tension);
}

const std::string two_rings = minimal + "[ring.a]\ncenter_m = [0.3, 0, 0]\nnormal = [1, 0, 0]\n" + ring_body +
                              "[ring.b]\njoint = \"contact\"\ncenter_m = [0.6, 0, 0]\nnormal = [1, 0, 0]\n" +
                              ring_body;

TEST(CaseReader, AMethodIsASetOfDefaults) {
  const Scene plain = parse_case(two_rings, "t.toml");
  EXPECT_EQ(plain.rings[0].joint, RingJoint::automatic);

  const Scene contact = parse_case(two_rings, "t.toml", {{"case.method", "\"contact\""}});
  EXPECT_EQ(contact.rings[0].joint, RingJoint::contact);
  EXPECT_EQ(contact.time.step, 0);

  const Scene paper = parse_case(two_rings, "t.toml", {{"case.method", "\"paper\""}});
  EXPECT_EQ(paper.contact.couple, RingCouple::paper);
  EXPECT_EQ(paper.contact.distance, DistanceMethod::golden);
  EXPECT_EQ(paper.contact.shared_node, SharedNode::paper);
  EXPECT_EQ(paper.time.step, 1e-6);
  EXPECT_EQ(paper.rings[0].joint, RingJoint::contact);

  const Scene sliding = parse_case(two_rings, "t.toml", {{"case.method", "\"sliding\""}});
  EXPECT_EQ(sliding.rings[0].joint, RingJoint::automatic);
  EXPECT_EQ(sliding.rings[1].joint, RingJoint::contact) << "a key that is given goes first";
  EXPECT_EQ(sliding.contact.couple, RingCouple::conserving);
  EXPECT_EQ(sliding.time.step, 0);
}

TEST(CaseReader, TheResolvedTextOfAMethodReadsAsTheSameScene) {
  const Scene paper = parse_case(two_rings, "t.toml", {{"case.method", "\"paper\""}});
  EXPECT_NE(paper.resolved_toml.find("step_s = 1e-06"), std::string::npos);
  const Scene again = parse_case(paper.resolved_toml, "again.toml");
  EXPECT_EQ(again.resolved_toml, paper.resolved_toml);
}

TEST(CaseReader, MethodsOfRowsOfRings) {
  const fs::path file = source_dir / "cases" / "capture.toml";
  for (const Ring& ring : read_case(file, {{"case.method", "\"sliding\""}}).rings)
    EXPECT_EQ(ring.joint, RingJoint::automatic);
  for (const Ring& ring : read_case(file).rings) EXPECT_EQ(ring.joint, RingJoint::contact);
}

TEST(CaseReader, AnUnknownMethodIsRefused) {
  expect_error(
      "schema = 1\n[case]\nmethod = \"best\"\n" + minimal.substr(11),
      {"t.toml:3:10: error: case.method: found \"best\"", "allowed: \"contact\", \"sliding\" or \"paper\""});
}

TEST(CaseReader, PartsKeepTheOrderOfTheFile) {
  std::string text = head + aramid;
  for (const std::string name : {"zeta", "alpha", "mid"})
    text += "[thread." + name +
            "]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nelements = 1\n"
            "points_m = [[0, 0, 0], [1, 0, 0]]\n";
  text += "[ring.z]\non = \"thread.mid\"\nelement = 0\n" + ring_body + net + "[rings.b]\nnet = \"main\"\n" +
          "edges = [\"left\"]\ncells = [2]\n" + ring_body + "[ring.a]\non = \"thread.zeta\"\nelement = 0\n" +
          ring_body;
  const Scene scene = parse_case(text, "t.toml");
  EXPECT_EQ(scene.threads[0].name, "zeta");
  EXPECT_EQ(scene.threads[1].name, "alpha");
  ASSERT_EQ(scene.rings.size(), 3u);
  EXPECT_EQ(scene.rings[0].name, "z");
  EXPECT_EQ(scene.rings[1].name, "b1");
  EXPECT_EQ(scene.rings[2].name, "a");
}

TEST(CaseReader, AxesAreNormalised) {
  const Scene scene = parse_case(head + aramid + net + "x_axis = [0, 3, 0]\ny_axis = [0, 0, -2]\n", "t.toml");
  EXPECT_EQ(scene.nets[0].x_axis, Vec3(0, 1, 0));
  EXPECT_EQ(scene.nets[0].y_axis, Vec3(0, 0, -1));
}

TEST(CaseReader, RingsSitOnTheMiddleElementOfTheirCell) {
  const Scene scene = parse_case(
      head + aramid + net + "elements_per_side = 3\n[rings.r]\nnet = \"main\"\ncells = [1, 10]\n" + ring_body,
      "t.toml");
  ASSERT_EQ(scene.rings.size(), 8u);
  EXPECT_EQ(scene.rings[0].element, 1);
  EXPECT_EQ(scene.rings[7].element, 28);
}

// ---- scenes the paper does not have
// --------------------------------------------------------------------------------

TEST(CaseReader, ThreadOverAFixedRingWithTwoMasses) {
  const Scene scene = parse_case(
      minimal +
          "start = { mass_kg = 0.1 }\nend = { mass_kg = 0.2 }\n[gravity]\nacceleration_m_s2 = [0, 0, -9.81]\n"
          "[ring.pulley]\ncenter_m = [0.5, 0, 0]\nnormal = [0, 2, 0]\nsupport = \"fixed\"\n" +
          ring_body,
      "t.toml");
  EXPECT_EQ(scene.rings[0].support, Support::fixed);
  EXPECT_EQ(scene.rings[0].normal, Vec3(0, 1, 0));
  EXPECT_EQ(scene.threads[0].end.mass, 0.2);
}

TEST(CaseReader, HangingNetWithMassesInside) {
  const Scene scene =
      parse_case(head + aramid + net +
                     "[net.main.node.top_left]\nsupport = \"fixed\"\n[net.main.node.\"knot.5.5\"]\n"
                     "mass_kg = 1\n[gravity]\nacceleration_m_s2 = [0, 0, -9.81]\n"
                     "[start]\nequilibrium = true\n",
                 "t.toml");
  ASSERT_EQ(scene.nets[0].nodes.size(), 2u);
  EXPECT_EQ(scene.nets[0].nodes.at("top_left").support, Support::fixed);
  EXPECT_EQ(scene.nets[0].nodes.at("knot.5.5").mass, 1);
  EXPECT_EQ(parse_case(scene.resolved_toml, "t.toml").resolved_toml, scene.resolved_toml);
}

TEST(CaseReader, NetWithoutRings) {
  const Scene scene = parse_case(head + aramid + net + mechanism, "t.toml");
  EXPECT_TRUE(scene.rings.empty());
  EXPECT_EQ(scene.mechanisms[0].launch_velocity, Vec3(0, 0, 0));
}

TEST(CaseReader, FreeRingOnATautInclinedThread) {
  const Scene scene =
      parse_case(head + aramid +
                     "[thread.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nelements = 50\n"
                     "points_m = [[0, 0, 1], [1, 0, 0]]\nlength_m = 1.4\nstart = { support = \"fixed\" }\n"
                     "end = { support = \"fixed\" }\n[ring.r]\ncenter_m = [0.5, 0, 0.5]\n"
                     "normal = [1, 0, -1]\n" +
                     ring_body,
                 "t.toml");
  EXPECT_EQ(scene.rings[0].support, Support::free);
  EXPECT_EQ(scene.threads[0].length, 1.4);
}

TEST(CaseReader, TwoThreadsThroughOneRing) {
  const Scene scene = parse_case(
      minimal +
          "[thread.second]\nmaterial = \"aramid\"\ndiameter_m = 0.001\nelements = 7\n"
          "points_m = [[0, 0.001, 0], [1, 0.001, 0]]\nstart = { on = \"thread.main.node.3\" }\n"
          "[ring.r]\ncenter_m = [0.5, 0, 0]\nnormal = [1, 0, 0]\nthreads = [\"main\", \"second\"]\n" +
          ring_body,
      "t.toml");
  EXPECT_EQ(scene.rings[0].threads, (std::vector<std::string>{"main", "second"}));
  EXPECT_EQ(scene.threads[1].start.on, "thread.main.node.3");
}

TEST(CaseReader, NetOf200By200MeshesWithRingsOnEveryEdgeCell) {
  const Scene scene = parse_case(head + aramid +
                                     "[net.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\n"
                                     "size_m = [20, 20]\nmesh_m = 0.1\n[rings.r]\nnet = \"main\"\n" +
                                     ring_body,
                                 "t.toml");
  EXPECT_EQ(scene.nets[0].columns(), 200);
  EXPECT_EQ(scene.rings.size(), 800u);
  EXPECT_EQ(scene.rings[799].element, 199);
}

TEST(CaseReader, NodesOfAThreadByNumber) {
  const Scene scene = parse_case(
      minimal + "[thread.main.node.4]\nmass_kg = 1\nsupport = \"guided\"\naxis = [0, 0, 5]\n", "t.toml");
  EXPECT_EQ(scene.threads[0].nodes.at(4).axis, Vec3(0, 0, 1));
}

// ---- overrides
// -----------------------------------------------------------------------------------------------------

TEST(CaseReader, OverridesChangeAndAddKeys) {
  const Scene scene =
      read_case(source_dir / "cases/capture.toml", {{"time.end_s", "1.5"},
                                                    {"time.step_s", "auto"},
                                                    {"output.frame_interval_s", "0.1"},
                                                    {"closing.time_s", "1.2"},
                                                    {"thread.c_top.elements", "300"},
                                                    {"contact.couple", "paper"},
                                                    {"case.title", "two words"},
                                                    {"net.main.node.\"knot.3.4\".mass_kg", "0.5"},
                                                    {"thread.c_left.start.mass_kg", "0.01"}});
  EXPECT_EQ(scene.time.end, 1.5);
  EXPECT_EQ(scene.time.step, 0);
  EXPECT_EQ(scene.output.frame_interval, 0.1);
  EXPECT_EQ(*scene.closing.time, 1.2);
  EXPECT_EQ(scene.threads[0].elements, 300);
  EXPECT_EQ(scene.contact.couple, RingCouple::paper);
  EXPECT_EQ(scene.title, "two words");
  EXPECT_EQ(scene.nets[0].nodes.at("knot.3.4").mass, 0.5);
  EXPECT_EQ(scene.threads[3].start.on, "mechanism.m4.b");
  EXPECT_EQ(scene.threads[3].start.mass, 0.01);
  EXPECT_NE(scene.resolved_toml.find("time_s = 1.2"), std::string::npos);
}

TEST(CaseReader, AStarOverridesAllPartsOfAKind) {
  const Scene scene = read_case(
      source_dir / "cases/capture.toml",
      {{"thread.*.elements", "12"}, {"thread.c_top.elements", "13"}, {"mechanism.*.launch_speed_m_s", "2"}});
  EXPECT_EQ(scene.threads[0].elements, 13) << "what comes later goes first";
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(scene.threads[i].elements, 12);
  for (const Mechanism& each : scene.mechanisms) EXPECT_NEAR(each.launch_velocity.norm(), 2, 1e-12);
  expect_error(minimal, {"--set ring.*.mass_kg=4: error: the case has no [ring.NAME]"},
               {{"ring.*.mass_kg", "4"}});
  try {
    read_case(source_dir / "cases/capture.toml", {{"thread.*.elements", "abc"}});
    FAIL() << "not refused";
  } catch (const CaseError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("thread.c_top.elements: found"), std::string::npos) << said;
    EXPECT_EQ(said.find("thread.c_right"), std::string::npos) << "told for each thread: " << said;
  }
  expect_error(minimal, {"--set thread.*.elemnts=4: error: unknown key 'thread.main.elemnts'"},
               {{"thread.*.elemnts", "4"}});
}

TEST(CaseReader, OverrideOfTheStepOfACase) {
  const Scene scene = read_case(source_dir / "cases/ring_pull.toml",
                                {{"time.step_s", "2e-6"}, {"thread.main.elements", "50"}});
  EXPECT_EQ(scene.time.step, 2e-6);
  EXPECT_EQ(scene.threads[0].elements, 50);
  EXPECT_EQ(scene.time.source.text, "--set time.step_s=2e-6");
}

TEST(CaseReader, FaultyOverridesAreNamed) {
  expect_error(minimal,
               {"--set time.end_s=abc: error: time.end_s: found \"abc\" (string), allowed: number in s"},
               {{"time.end_s", "abc"}});
  expect_error(minimal, {"--set time.end=3: error: unknown key 'time.end' (did you mean 'end_s'?)"},
               {{"time.end", "3"}});
  expect_error(minimal,
               {"--set thread.mian.elements=4: error: the case has no thread 'mian' (did you mean 'main'?)",
                "threads of this case: main"},
               {{"thread.mian.elements", "4"}});
  expect_error(minimal, {"--set ring.r.mass_kg=4: error: the case has no [ring.NAME]"},
               {{"ring.r.mass_kg", "4"}});
  expect_error(minimal, {"--set tmie.end_s=4: error: unknown section 'tmie' (did you mean 'time'?)"},
               {{"tmie.end_s", "4"}});
  expect_error(minimal, {"--set time..end_s=4: error: 'time..end_s' is no key path"}, {{"time..end_s", "4"}});
  expect_error(minimal, {"--set time.end_s.x=4: error: 'end_s' is a value and has no key 'x'"},
               {{"time.end_s.x", "4"}});
  expect_error(minimal, {"--set thread.main=4: error: 'thread.main': found 4 (integer)"},
               {{"thread.main", "4"}});
  expect_error(minimal, {"--set case.title=\xC3\xA4: error: only ASCII"}, {{"case.title", "\xC3\xA4"}});
  expect_error(minimal, {"--set schema=2: error: schema: found 2"}, {{"schema", "2"}});
  expect_error(minimal,
               {"--set thread.main.start={ mass_kg = -1 }: error: thread.main.start.mass_kg: found -1"},
               {{"thread.main.start", "{ mass_kg = -1 }"}});
}

TEST(CaseReader, NodesAreTables) {
  const std::string instead = ", allowed: a table of the keys of a node";
  for (const std::string key : {"start", "node", "node.3"})
    expect_error(minimal, {"thread.main." + key + ": found 5 (integer)" + instead},
                 {{"thread.main." + key, "5"}});
}

TEST(CaseReader, AnOverrideCannotSmuggleInOtherKeys) {
  const Scene scene = parse_case(minimal, "t.toml", {{"case.title", "a\nschema = 7"}});
  EXPECT_EQ(scene.title, "a\nschema = 7");
}

// ---- mistakes
// ------------------------------------------------------------------------------------------------------

TEST(CaseReader, SyntaxErrorsHaveAPlace) {
  expect_error("schema = 1\n[time]\nend_s = = 3\n",
               {"t.toml:3:9: error: ", "    end_s = = 3\n            ^"});
  expect_error("schema = 1\nschema = 1\n", {"t.toml:2:10: error: ", "redefine", "schema"});
  expect_error(minimal + "[thread.main]\n", {"t.toml:12:", "error: "});
}

TEST(CaseReader, SchemaIsRequired) {
  expect_error("[time]\nend_s = 1\n", {"t.toml:1:1: error: missing key 'schema'", "schema = 1"});
  expect_error("schema = 2\n",
               {"t.toml:1:10: error: schema: found 2 (integer), allowed: 1", "newer program"});
  expect_error("schema = \"1\"\n", {"t.toml:1:10: error: schema: found \"1\" (string), allowed: 1"});
}

TEST(CaseReader, UnknownKeysAndSections) {
  expect_error(minimal + "dampnig = 3\n",
               {"t.toml:12:1: error: unknown key 'thread.main.dampnig'", "    dampnig = 3\n    ^",
                "allowed in [thread.NAME]: material, diameter_m"});
  expect_error(minimal + "length = 3\n",
               {"12:1: error: unknown key 'thread.main.length' (did you mean 'length_m'?)"});
  expect_error(minimal + "[gravty]\n", {"12:2: error: unknown section 'gravty' (did you mean 'gravity'?)"});
  expect_error("foo = 1\n" + minimal, {"1:1: error: unknown key 'foo'"});
  expect_error(minimal + "start = { mas_kg = 1 }\n",
               {"12:11: error: unknown key 'thread.main.start.mas_kg' (did you mean 'mass_kg'?)",
                "allowed for a node: on"});
}

TEST(CaseReader, MissingKeysAndSections) {
  expect_error("schema = 1\n" + aramid + thread, {"t.toml:1:1: error: missing section [time]",
                                                  "required in it: end_s (number in s, > 0 and <= 1e+06)"});
  expect_error("schema = 1\n[time]\n" + aramid + thread,
               {"t.toml:2:2: error: missing key 'time.end_s'", "allowed: number in s, > 0"});
  expect_error(head + aramid + "[thread.main]\nelements = 1\n",
               {"missing key 'thread.main.material'", "missing key 'thread.main.diameter_m'",
                "missing key 'thread.main.points_m' (or 'along')"});
  expect_error(head, {"neither a [net.NAME] nor a [thread.NAME]"});
  expect_error(minimal + "[ring.r]\non = \"thread.main\"\n" + ring_body, {"missing key 'ring.r.element'"});
}

// One error for a slip of the pen, not one for what it is not and one for what is missing.
TEST(CaseReader, AMisspeltRequiredKeyIsOneMistake) {
  const std::vector<std::array<std::string, 3>> slips{{"end_s = 1", "end_ms = 1", "'end_s'"},
                                                      {"end_s = 1", "edn_s = 1", "'end_s'"},
                                                      {"diameter_m", "diameter_mm", "'diameter_m'"},
                                                      {"density_kg_m3", "density_g_cm3", "'density_kg_m3'"},
                                                      {"[time]", "[tiem]", "'time'"}};
  for (const auto& [right, wrong, meant] : slips) {
    std::string text = minimal;
    text.replace(text.find(right), right.size(), wrong);
    const std::string error = error_of(text);
    EXPECT_EQ(count_errors(error), 1u) << error;
    EXPECT_NE(error.find("(did you mean " + meant + "?)"), std::string::npos) << error;
  }
}

TEST(CaseReader, AKnotWithoutQuotes) {
  const std::string error = error_of(head + aramid + net + "[net.main.node.knot.3.4]\nmass_kg = 1\n");
  EXPECT_EQ(count_errors(error), 1u) << error;
  EXPECT_NE(error.find("the name of a knot has dots, so it needs quotes"), std::string::npos) << error;
  EXPECT_NE(error.find("example: [net.main.node.\"knot.3.4\"]"), std::string::npos) << error;
}

TEST(CaseReader, TwoMechanismsOnOneCorner) {
  std::string second = mechanism;
  second.replace(second.find("m1"), 2, "m2");
  const std::string error = error_of(head + "[closing]\ntime_s = 0.5\n" + aramid + net + mechanism + second);
  EXPECT_EQ(count_errors(error), 1u) << error;
  EXPECT_NE(
      error.find("t.toml:23:10: error: mechanism.m2.corner: found \"net.main.top_left\", on which mechanism "
                 "'m1' hangs, allowed: "),
      std::string::npos)
      << error;
}

TEST(CaseReader, WrongTypesAndRanges) {
  const auto time = [](const std::string& line) {
    return "schema = 1\n[time]\n" + line + "\n" + aramid + thread;
  };
  expect_error(
      time("end_s = \"1\""),
      {"t.toml:3:9: error: time.end_s: found \"1\" (string), allowed: number in s, > 0 and <= 1e+06"});
  expect_error(time("end_s = -1"), {"found -1 (integer), allowed: number in s, > 0"});
  expect_error(time("end_s = 0.0"), {"found 0.0 (number)"});
  expect_error(time("end_s = nan"), {"found nan (number)"});
  expect_error(time("end_s = inf"), {"found inf (number)"});
  expect_error(time("end_s = 2020-01-01"), {"found a date or time"});
  expect_error(time("end_s = 1\nstep_s = \"atuo\""), {"4:10", "(did you mean 'auto'?)", "or \"auto\""});
  expect_error(time("end_s = 1\nallow_unstable = 1"), {"found 1 (integer), allowed: true or false"});
  expect_error(time("end_s = 1\nstep_s = 2.0"),
               {"4:10: error: time.step_s: found 2.0 (number), allowed: number in s, > 0 and <= 1"});
  expect_error(minimal + "velocity_m_s = [1, 2]\n",
               {"12:16: error: thread.main.velocity_m_s: found [1, 2] (array of 2), allowed: [x, y, z]"});
  expect_error(minimal + "velocity_m_s = [1, \"2\", 3]\n", {"12:20: error: "});
  expect_error(minimal + "start = 5\n",
               {"12:9: error: thread.main.start: found 5 (integer), allowed: a table"});
  expect_error(
      minimal + "start = { support = \"fix\" }\n",
      {"found \"fix\" (string) (did you mean 'fixed'?), allowed: \"free\", \"guided\" or \"fixed\""});
  expect_error("time = 3\n" + aramid, {"missing key 'schema'"});
  expect_error("schema = 1\ntime = 3\n" + aramid + thread,
               {"2:8: error: 'time': found 3 (integer), allowed: a section [time]"});
  expect_error(minimal + "[[ring]]\nx = 1\n", {"'ring': found", "allowed: a section [ring.NAME]"});
  expect_error(minimal + "[ring]\nmass_kg = 1\n",
               {"'ring.mass_kg': found 1 (integer), allowed: a section [ring.NAME] (parts have names)"});
  expect_error(minimal + "[ring.\"a.b\"]\n", {"is no name of a part", "letters, digits, _ and -"});
}

TEST(CaseReader, ElementsAreWholeAndBounded) {
  const auto elements = [](const std::string& number) {
    return head + aramid +
           "[thread.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\npoints_m = [[0, 0, 0], [1, 0, "
           "0]]\nelements = " +
           number + "\n";
  };
  for (const char* bad : {"0", "-5", "100000001", "9223372036854775807", "10.0", "\"10\"", "true"}) {
    SCOPED_TRACE(bad);
    expect_error(elements(bad), {"t.toml:11:12: error: thread.main.elements: found ",
                                 "allowed: whole number, >= 1 and <= 100000000"});
  }
  for (const char* point : {"10.0", "1e8"})
    expect_error(elements(point), {"(number), ", "<= 100000000, written without point and exponent"});
  for (const char* other : {"10.5", "0", "inf"})
    EXPECT_EQ(error_of(elements(other)).find("without point"), std::string::npos) << other;
  EXPECT_EQ(error_of(elements("100000000")), "");
}

TEST(CaseReader, KeysThatExcludeOrNeedEachOther) {
  expect_error(minimal + "along = [\"net.main.top\"]\n" + net,
               {"11:1: error: 'thread.main.points_m' cannot stand beside 'along' (t.toml:12:1)"});
  expect_error(minimal + "overhang_end_m = 1\n",
               {"12:1: error: 'thread.main.overhang_end_m' has a meaning only beside 'along'"});
  expect_error(minimal + "[ring.r]\non = \"thread.main\"\nelement = 1\nnormal = [1, 0, 0]\n" + ring_body,
               {"'ring.r.normal' cannot stand beside 'on'"});
  expect_error(minimal + "start = { support = \"guided\" }\n",
               {"12:21: error: missing key 'thread.main.start.axis'"});
  expect_error(minimal + "start = { axis = [1, 0, 0] }\n",
               {"'thread.main.start.axis' has a meaning only with support = \"guided\""});
  expect_error(head + aramid + "damping_rule = \"stiffness\"\n" + thread,
               {"missing key 'material.aramid.damping_frequency_rad_s'"});
  expect_error(head + aramid + net + mechanism + "launch_velocity_m_s = [0, 0, 1]\nlaunch_speed_m_s = 1\n",
               {"'mechanism.m1.launch_speed_m_s' cannot stand beside 'launch_velocity_m_s'"});
  expect_error(minimal + "[start]\nequilibrium = true\n",
               {"13:15: error: start.equilibrium: found true in a case without [gravity]"});
}

TEST(CaseReader, GeometryMustMakeSense) {
  expect_error(head + aramid + net + "x_axis = [1, 0, 0]\ny_axis = [1, 1, 0]\n",
               {"13:10: error: net.main.y_axis: ", "right angles"});
  expect_error(head + aramid + net + "x_axis = [0, 0, 0]\n",
               {"net.main.x_axis: found [0, 0, 0] (array of 3), allowed: [x, y, z]: a direction, not zero"});
  expect_error(
      head + aramid +
          "[net.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nsize_m = [1, 0.95]\nmesh_m = 0.1\n",
      {"t.toml:11:10: error: net.main.mesh_m: found 0.1 with size_m = [1, 0.95], allowed: a whole number of "
       "meshes"});
  expect_error(head + aramid +
                   "[net.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nsize_m = [1, 1]\nmesh_m = 1e-7\n",
               {"net.main.mesh_m: found 1e-07, which makes 1e+14 meshes"});
  expect_error(
      head + aramid + thread.substr(0, thread.find("points_m")) + "points_m = [[0, 0, 0], [0, 0, 0]]\n",
      {"11:24: error: ", "points that differ"});
  expect_error(head + aramid + thread.substr(0, thread.find("points_m")) + "points_m = [[0, 0, 0]]\n",
               {"two points or more"});
  expect_error(minimal + "[ring.r]\non = \"thread.main\"\nelement = 10\n" + ring_body,
               {"14:11: error: ring.r.element: found 10, allowed: 0 to 9 on thread.main"});
  expect_error(minimal + "[ring.r]\non = \"thread.main\"\nelement = 1\ndiameter_m = 0.004\n" +
                   ring_body.substr(ring_body.find("wire")),
               {"ring.r.wire_diameter_m: found 0.004, allowed: below diameter_m"});
  expect_error(head + aramid + net + "[rings.r]\nnet = \"main\"\ncells = [1, 11]\n" + ring_body,
               {"14:9: error: rings.r.cells: found 11, allowed: 1 to 10 on net.main.top"});
  expect_error(head + aramid + net + "[rings.r]\nnet = \"main\"\ncells = [1, 1]\n" + ring_body,
               {"none twice"});
  expect_error(minimal + "[thread.main.node.11]\n", {"no such node", "0 to 10"});
  expect_error(minimal + "[thread.main.node.x]\n", {"no such node"});
}

TEST(CaseReader, UnknownReferences) {
  expect_error(head + aramid +
                   "[thread.main]\nmaterial = \"aramd\"\ndiameter_m = 1\nelements = 1\npoints_m = [[0, 0, "
                   "0], [1, 0, 0]]\n",
               {"t.toml:8:12: error: thread.main.material: unknown material 'aramd' (did you mean 'aramid'?)",
                "materials of this case: aramid"});
  expect_error(minimal + "start = { on = \"mechanism.m1.a\" }\n",
               {"12:16: error: thread.main.start.on: unknown mechanism 'm1'", "no [mechanism.NAME]"});
  const std::string closing = head + "[closing]\ntime_s = 0\n" + aramid + net +
                              "[thread.c]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nelements = 10\n";
  expect_error(closing + "along = [\"net.main.top\", \"net.main.rihgt\"]\n",
               {"18:26: error: thread.c.along: no place 'rihgt' of 'net.main' can be used here (did you mean "
                "'right'?)",
                "allowed: mechanism.NAME, net.NAME.top|right|bottom|left"});
  expect_error(closing + "along = [\"net.mian.top\"]\n", {"unknown net 'mian' (did you mean 'main'?)"});
  expect_error(closing + "along = [\"net.main\"]\n", {"'net.main' lacks its last part, the place"});
  expect_error(closing + "along = [\"thread.main\"]\n", {"'thread.main' cannot be used here"});
  expect_error(closing + "along = []\n", {"thread.c.along: found [], allowed: one part or more"});
  expect_error(
      closing +
          "along = [\"net.main.top\"]\n[ring.r]\non = \"net.main.top\"\nelement = 0\nthreads = [\"d\"]\n" +
          ring_body,
      {"22:12: error: ring.r.threads: unknown thread 'd'"});
  expect_error(head + aramid + net + "[net.main.node.\"knot.11.0\"]\nmass_kg = 1\n",
               {"net 'main' has no 'knot.11.0'", "knot.0.0 to knot.10.10"});
  expect_error(minimal + "[probe.p]\nquantity = \"position\"\nof = \"thread.main.node.11\"\n",
               {"14:6: error: probe.p.of: thread 'main' has no node 11", "allowed: 0 to 10"});
  expect_error(minimal + "[probe.p]\nquantity = \"position\"\n", {"missing key 'probe.p.of'"});
  expect_error(minimal + "[probe.p]\nquantity = \"energy\"\nof = \"thread.main\"\n",
               {"'probe.p.of' has no meaning"});
  expect_error(minimal + "[probe.p]\nquantity = \"mouth_area\"\n", {"in a case without rings"});
  expect_error(minimal + "[ring]\n[probe.p]\nquantity = \"mouth_area\"\n", {"in a case without rings"});
  expect_error(
      minimal +
          "[target.b]\ncenter_m = [0, 0, 0]\nradius_m = 1\nyoungs_modulus_Pa = 1e9\ntouches = [\"main\"]\n",
      {"'main' cannot be used here", "allowed: net.NAME, thread.NAME, mechanism.NAME"});
}

TEST(CaseReader, AFaultyPartIsNoSecondError) {
  const std::string error = error_of(
      head + aramid +
      "[net.main]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nsize_m = [1, 1]\nmesh_m = -1\n" + mechanism +
      "[rings.r]\nnet = \"main\"\n" + ring_body + "[probe.p]\nquantity = \"force\"\nof = \"ring.r1\"\n");
  EXPECT_EQ(count_errors(error), 1u) << error;
}

// A net whose meshes do not fill it, and a ring that lacks a key: the case has rings for all that.
TEST(CaseReader, AFaultyRingIsNoSecondError) {
  const std::string mouth = "[probe.p]\nquantity = \"mouth_area\"\n";
  const std::string row = head + aramid + net + "[rings.r]\nnet = \"main\"\n" + ring_body + mouth;
  const std::string uneven = error_of(row, {{"net.main.mesh_m", "0.3"}});
  EXPECT_EQ(count_errors(uneven), 1u) << uneven;
  EXPECT_NE(uneven.find("net.main.mesh_m"), std::string::npos) << uneven;
  const std::string lacking = error_of(minimal + "[ring.r]\non = \"thread.main\"\n" + ring_body + mouth);
  EXPECT_EQ(count_errors(lacking), 1u) << lacking;
}

TEST(CaseReader, AFaultyEndIsNoSecondError) {
  EXPECT_EQ(count_errors(error_of(minimal, {{"time.end_s", "-1"}, {"time.step_s", "1e-6"}})), 1u);
}

TEST(CaseReader, MassesAreSpheresWhereTheyHaveARadius) {
  const Scene scene = parse_case(
      head + aramid + net + mechanism + "launcher_radius_m = 0.02\nsplit_radius_m = 0.03\n" +
          "split_youngs_modulus_Pa = 2e9\n[thread.t]\nmaterial = \"aramid\"\ndiameter_m = 0.002\n" +
          "elements = 1\npoints_m = [[0, 0, 1], [0, 0, 2]]\nend = { mass_kg = 1, radius_m = 0.1, "
          "youngs_modulus_Pa = 3e9, poissons_ratio = 0.2 }\n[closing]\ntime_s = 0\n",
      "t.toml");
  const Mechanism& m = scene.mechanisms[0];
  EXPECT_EQ(m.launcher_sphere.radius, 0.02);
  EXPECT_EQ(m.launcher_sphere.youngs_modulus, 0);  // as the target
  EXPECT_EQ(m.split_sphere.radius, 0.03);
  EXPECT_EQ(m.split_sphere.youngs_modulus, 2e9);
  EXPECT_EQ(m.split_sphere.poissons_ratio, 0.3);
  const Sphere& end = scene.threads[0].end.sphere;
  EXPECT_EQ(end.radius, 0.1);
  EXPECT_EQ(end.youngs_modulus, 3e9);
  EXPECT_EQ(end.poissons_ratio, 0.2);
  EXPECT_EQ(scene.threads[0].start.sphere.radius, 0);
  expect_error(minimal + "start = { youngs_modulus_Pa = 1e9 }\n", {"has a meaning only beside 'radius_m'"});
}

TEST(CaseReader, ClosingThreadsNeedAClosingTime) {
  expect_error(head + aramid + net +
                   "[thread.c]\nmaterial = \"aramid\"\ndiameter_m = 0.002\nelements = 10\nalong = "
                   "[\"net.main.top\"]\n",
               {"t.toml:16:9: error: a thread laid 'along' other parts needs a closing time", "[closing]"});
}

TEST(CaseReader, TwoRingsOfOneNameAreRefused) {
  expect_error(head + aramid + net + "[rings.r]\nnet = \"main\"\n" + ring_body +
                   "[ring.r3]\non = \"net.main.top\"\nelement = 0\n" + ring_body,
               {"a second ring is called 'r3'"});
}

TEST(CaseReader, FramesSamplesAndStepsAreBounded) {
  expect_error(
      minimal + "[output]\nframe_interval_s = 1e-7\n",
      {"13:20: error: output.frame_interval_s: found 1e-07 with time.end_s = 1, allowed: >= 1e-06 s"});
  expect_error(minimal + "[output]\nprobe_interval_s = 1e-8\n", {"output.probe_interval_s: found 1e-08"});
  expect_error(minimal + "[output]\ncheckpoint_interval_s = 1e-7\n",
               {"13:25: error: output.checkpoint_interval_s: found 1e-07 with time.end_s = 1, allowed: 0, or "
                ">= 1e-06 s"});
  EXPECT_EQ(error_of(minimal + "[output]\ncheckpoint_interval_s = 1e-6\n"), "");
  expect_error(minimal, {"--set time.step_s=1e-13: error: time.step_s: found 1e-13"},
               {{"time.step_s", "1e-13"}});
  expect_error(minimal, {"allowed: a step below the end"}, {{"time.step_s", "1e-2"}, {"time.end_s", "1e-3"}});
}

TEST(CaseReader, AllErrorsAtOnceButTwentyShown) {
  std::string text = minimal;
  for (int i = 0; i < 30; ++i) text += "k" + std::to_string(i) + " = 1\n";
  const std::string error = error_of(text);
  EXPECT_EQ(count_errors(error), 21u);
  EXPECT_NE(error.find("t.toml: error: 10 more"), std::string::npos) << error;
}

// ---- hostile input
// -------------------------------------------------------------------------------------------------

TEST(CaseReader, NonAsciiOnlyInComments) {
  EXPECT_EQ(error_of("# \xC2\xB5m\n" + minimal), "");
  EXPECT_EQ(error_of("\xEF\xBB\xBF" + minimal), "");
  expect_error("schema = 1\n[t\xC3\xA4me]\n",
               {"t.toml:2:3: error: only ASCII characters are allowed outside of comments"});
  expect_error("schema = 1\n[case]\ntitle = \"# \xC3\xA4\"\n", {"t.toml:3:12: error: only ASCII"});
  expect_error(std::string("schema = 1\n\0", 12), {"t.toml:2:1: error: the file contains a NUL byte"});
}

TEST(CaseReader, MalformedTextsThatAssertInTheParser) {
  for (const char* text : {"[&", "[?x]", "[", "[\r", "[\n", "a.", "=", "\"", "'''", "\"\"\"\\", "[[", "x = [",
                           "x = {", "x = 0x", "\\"}) {
    SCOPED_TRACE(text);
    EXPECT_NE(error_of(text).find("error: "), std::string::npos);
  }
}

TEST(CaseReader, DeepNestingIsRefused) {
  std::string dots = "a";
  for (int i = 0; i < 200000; ++i) dots += ".a";
  EXPECT_NE(error_of("[" + dots + "]\n").find("a key of more than 32 parts"), std::string::npos);
  EXPECT_NE(error_of(dots + " = 1\n").find("a key of more than 32 parts"), std::string::npos);
  EXPECT_NE(error_of("x = { " + dots + " = 1 }\n").find("a key of more than 32 parts"), std::string::npos);
  EXPECT_NE(error_of("x = " + std::string(200000, '[')).find("t.toml:1:"), std::string::npos);
  std::string tables = "schema = 1\nx = ";
  for (int i = 0; i < 100000; ++i) tables += "{a=";
  EXPECT_NE(error_of(tables).find("t.toml:2:"), std::string::npos);
}

TEST(CaseReader, HugeInputIsRefusedInGoodTime) {
  EXPECT_NE(error_of(std::string((64u << 20) + 1, ' ')).find("larger than 64 MiB"), std::string::npos);
  std::string many = minimal;
  for (int i = 0; i < 20000; ++i) many += "key" + std::to_string(i) + " = 1\n";
  EXPECT_NE(error_of(many).find("980 more or many more"), std::string::npos);
  const std::string long_line = error_of(minimal + "velocity_m_s = [" + std::string(100000, ' ') + "1, 2]\n");
  EXPECT_LT(long_line.size(), 1000u);
}

TEST(CaseReader, FilesThatCannotBeRead) {
  EXPECT_THROW(read_case("/nonexistent/case.toml"), CaseError);
  EXPECT_THROW(read_case(source_dir), CaseError);
}

}  // namespace
}  // namespace cinch
