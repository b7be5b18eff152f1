// What the problems of the study have in common.
#pragma once
#include "problem.hpp"

namespace cinch::study {

/// Contact with all of the paper's rules, and with one of them alone.
inline constexpr const char* papers_rules = "contact, paper's rules";
inline constexpr const char* papers_distance = "contact, paper's golden section";
inline constexpr const char* papers_couple = "contact, paper's couple";
inline constexpr const char* papers_nodes = "contact, paper's shared nodes";

/// A case of the project's with a setting's threads, rings and step, and without probes; `change` comes
/// first.
Scene scene_of(const std::string& name, const Setting& setting,
               const std::function<void(Scene&)>& change = {});

/// Series of settings: with steps by fractions of the stable one, and with the paper's step.
void add_series(std::vector<Setting>& to, const std::string& method, const std::vector<int>& elements,
                double fraction, int joint_steps = 1);
void add_papers_step(std::vector<Setting>& to, const std::string& method, const std::vector<int>& elements,
                     const std::vector<int>& papers);

/// From the closing time on.
void set_closing_fraction(std::vector<Setting>& settings, double fraction);
/// Of each setting.
void set_runs(std::vector<Setting>& settings, int runs);

/// Distance between places whose coordinates stand at [first, last) of two samples.
double distance(const std::vector<double>& a, const std::vector<double>& b, std::size_t first,
                std::size_t last);
/// Its greatest value over all samples.
double greatest(const Track& a, const Track& b, std::size_t first, std::size_t last);

void append(std::vector<double>& to, const Vec3& place);

/// Greatest force that any ring has felt by now, N.
double peak_ring_force(const Simulation& sim);
/// How far two numbers that stand last in the tracks' samples, or `back` before that, are apart, of the
/// second.
double last_apart(const Track& found, const Track& reference, std::size_t back = 0);

}  // namespace cinch::study
