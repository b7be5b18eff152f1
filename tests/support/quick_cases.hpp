// The cases, changed so that they close and touch within some thousand steps.
#pragma once
#include <string>
#include <vector>

#include "input/case_reader.hpp"

namespace cinch::test {

struct Case {
  const char* name;
  std::vector<Override> sets;
  std::int64_t steps;
};

inline std::string case_file(const Case& one) {
  return std::string(CINCH_SOURCE_DIR) + "/cases/" + one.name + ".toml";
}

inline Scene read(const Case& one) { return read_case(case_file(one), one.sets); }

// The thread starts 0.1 mm from the wire.
inline Case ring_pull() {
  return {
      "ring_pull", {{"thread.main.velocity_m_s", "[0, 0, -1]"}, {"ring.r1.center_m", "[0, 0, 0.0069]"}}, 400};
}

// The masses fall under 100 g, the rings are narrow.
inline Case edge_closure() {
  return {"edge_closure",
          {{"gravity.acceleration_m_s2", "[0, 0, -981]"}, {"rings.r.diameter_m", "0.0043"}},
          1200};
}

// Deployed, at the ball, narrow rings, fast split masses: closes at step 100.
inline Case capture() {
  Case one{"capture",
           {{"net.main.stowed_factor", "1"},
            {"closing.time_s", "0.0001"},
            {"rings.r.diameter_m", "0.0062"},
            {"target.ball.center_m", "[0.05, 0, 0.1505]"}},
           1000};
  const char* const ways[4][2] = {{"[-10, -10, 0]", "[10, 10, 0]"},
                                  {"[-10, 10, 0]", "[10, -10, 0]"},
                                  {"[10, 10, 0]", "[-10, -10, 0]"},
                                  {"[10, -10, 0]", "[-10, 10, 0]"}};
  for (std::size_t m = 0; m < 4; ++m) {
    const std::string mechanism = "mechanism.m" + std::to_string(m + 1);
    one.sets.push_back({mechanism + ".separation_a_m_s", ways[m][0]});
    one.sets.push_back({mechanism + ".separation_b_m_s", ways[m][1]});
  }
  return one;
}

// What makes the large capture one with a net of `columns` meshes a side, a ring in each mesh of each edge.
inline std::vector<Override> large_capture_with(int columns) {
  const std::string size = std::to_string(0.1 * columns), length = std::to_string(0.1 * columns + 0.2);
  std::vector<Override> sets{{"net.main.size_m", "[" + size + ", " + size + "]"}};
  for (const char* thread : {"c_top", "c_right", "c_bottom", "c_left"}) {
    sets.push_back({std::string("thread.") + thread + ".elements", std::to_string(20 * (columns + 2))});
    sets.push_back({std::string("thread.") + thread + ".length_m", length});
  }
  for (const char* mechanism : {"m1", "m2", "m3", "m4"}) {
    sets.push_back({std::string("mechanism.") + mechanism + ".towing_length_m", "0.1"});
    sets.push_back({std::string("mechanism.") + mechanism + ".towing_elements", "1"});
  }
  return sets;
}

// The large capture at 0.5 m instead of 20 m, with narrow rings.
inline Case small_large_capture() {
  Case one{"large_capture", large_capture_with(5), 800};
  one.sets.insert(one.sets.end(), {{"closing.time_s", "0.0002"},
                                   {"rings.r.diameter_m", "0.0142"},
                                   {"target.ball.radius_m", "0.2"},
                                   {"target.ball.center_m", "[0.05, 0.05, 0.2008]"}});
  for (const char* thread : {"c_top", "c_right", "c_bottom", "c_left"})
    one.sets.push_back({std::string("thread.") + thread + ".elements", "70"});
  return one;
}

// The same scenes with rings that slide; the capture's begin with two in one element.
inline Case sliding(Case one, int elements, const char* step, std::int64_t steps) {
  one.sets.push_back(
      {one.name == std::string("ring_pull") ? "ring.r1.joint" : "rings.r.joint", "\"sliding\""});
  one.sets.push_back({"time.step_s", step});
  one.steps = steps;
  if (one.name == std::string("ring_pull")) {
    one.sets.push_back({"thread.main.elements", std::to_string(elements)});
    return one;
  }
  for (const char* thread : {"c_top", "c_right", "c_bottom", "c_left"})
    one.sets.push_back({std::string("thread.") + thread + ".elements", std::to_string(elements)});
  return one;
}
inline Case sliding_ring_pull() {
  return sliding({"ring_pull", {{"thread.main.velocity_m_s", "[0, 0, -1]"}}, 0}, 26, "2e-5", 20000);
}
inline Case sliding_capture() { return sliding(capture(), 3, "4e-6", 8000); }
inline Case held_capture() {
  Case one = sliding_capture();
  one.sets.push_back({"time.joint_steps", "3"});
  one.steps = 7999;  // two of the last three
  return one;
}

// Closes at step 25 and has shorter steps from then on.
inline Case capture_in_two_steps() {
  Case one = held_capture();
  one.sets.push_back({"closing.step_s", "2.5e-6"});
  return one;
}

// The large capture in full size: hundreds of blocks, few steps.
inline Case full_large_capture() {
  return {"large_capture", {{"closing.time_s", "0.00004"}, {"target.ball.center_m", "[0, 0, 3.0005]"}}, 60};
}

}  // namespace cinch::test
