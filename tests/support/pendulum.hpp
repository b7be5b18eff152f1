// A mass of 1 kg on a metre of thread in one element, let go level: a case of few lines and long steps.
#pragma once
#include <string>

namespace cinch::test {

/// `head` holds [time] and what else is to stand before the material, `tail` what follows on the thread.
inline std::string pendulum_case(const std::string& head, const std::string& modulus,
                                 const std::string& tail = "") {
  return "schema = 1\n" + head + R"([material.m]
density_kg_m3 = 970
youngs_modulus_Pa = )" +
         modulus + R"(
[thread.main]
material = "m"
diameter_m = 0.002
elements = 1
points_m = [[0, 0, 0], [1, 0, 0]]
start = { support = "fixed" }
end = { mass_kg = 1 }
)" + tail;
}

inline const std::string falling = "[gravity]\nacceleration_m_s2 = [0, 0, -9.81]\n";

}  // namespace cinch::test
