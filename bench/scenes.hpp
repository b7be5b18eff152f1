// Scenes that several suites measure, as case texts.
#pragma once
#include <string>

#include "input/case_reader.hpp"

namespace cinch::bench {

/// What a scene without contacts can have besides elements and nodes.
struct Features {
  bool damping = true, ledger = true, gravity = false;
};

/// The modulus of a material so soft that what is stretched stays taut for as long as anything is timed:
/// slack elements cost less.
inline const std::string stays_taut = "1";

inline std::string case_head(const Features& has, const std::string& modulus_Pa = "1e9") {
  return std::string("schema = 1\n[time]\nend_s = 100\nstep_s = 1e-6\n[output]\nledger = ") +
         (has.ledger ? "true" : "false") +
         (has.gravity ? "\n[gravity]\nacceleration_m_s2 = [0, 0, -9.81]" : "") +
         "\n[material.m]\nyoungs_modulus_Pa = " + modulus_Pa + "\ndensity_kg_m3 = 970\n" +
         (has.damping ? "" : "damping_ratio = 0\n");
}

/// ring_pull's thread with as many elements of 5 mm as asked for, taut by 1 %.
inline Scene chain_scene(std::int64_t elements, bool ledger) {
  const double rest = 0.005 * static_cast<double>(elements);
  return parse_case(case_head({.ledger = ledger}, stays_taut) +
                        "[thread.main]\nmaterial = \"m\"\ndiameter_m = 0.002\nelements = " +
                        std::to_string(elements) + "\npoints_m = [[0, 0, 0], [" +
                        std::to_string(1.01 * rest) + ", 0, 0]]\nlength_m = " + std::to_string(rest) + "\n",
                    "chain.toml");
}

/// A flying square net of knots x knots with one element a mesh side, taut by 0.1 %.
inline std::string net_text(std::int64_t knots, const Features& has = {}) {
  const std::string side = std::to_string(0.1 * static_cast<double>(knots - 1));
  return case_head(has, stays_taut) + "[net.main]\nmaterial = \"m\"\ndiameter_m = 0.002\nsize_m = [" + side +
         ", " + side + "]\nmesh_m = 0.1\nstowed_factor = 1.001\nvelocity_m_s = [0, 0, 1]\n";
}

/// The nets that bench/README.md compares with other programs', taut as well: 781 nodes and 880 elements; and
/// with four threads of 239 nodes beside it, as closing threads lie, 1,737 nodes and 1,832 elements.
inline Scene peers_net_scene(bool with_threads) {
  std::string text = net_text(11);
  text.insert(text.find("mesh_m"), "elements_per_side = 4\n");
  for (int i = 0; i < (with_threads ? 4 : 0); ++i) {
    const std::string y = std::to_string(1 + 0.1 * i);
    text += "[thread.t" + std::to_string(i) +
            "]\nmaterial = \"m\"\ndiameter_m = 0.002\nelements = 238\npoints_m = [[0, " + y +
            ", 0], [1.2012, " + y + ", 0]]\nlength_m = 1.2\n";
  }
  return parse_case(text, "net.toml");
}

inline Scene net_scene(std::int64_t knots, const Features& has = {}) {
  return parse_case(net_text(knots, has), "net.toml");
}

/// One of the repository's own cases.
inline std::string case_file(const std::string& name) { return CINCH_SOURCE_DIR "/cases/" + name + ".toml"; }

}  // namespace cinch::bench
