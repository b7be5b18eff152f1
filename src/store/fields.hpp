// The table of node fields: it drives allocation and the state hash, and tells what there is to store.
#pragma once
#include "store/state.hpp"

namespace cinch {

struct NodeField {
  const char* name;
  const char* meaning;
  const char* unit;
  const char* writer;  ///< the stage that writes it
  AlignedVector<double> State::*values;
};

inline constexpr NodeField node_fields[] = {
    // clang-format off
    {"x",  "position",                        "m",   "node_update", &State::x},
    {"y",  "position",                        "m",   "node_update", &State::y},
    {"z",  "position",                        "m",   "node_update", &State::z},
    {"vx", "velocity half a step earlier",    "m/s", "node_update", &State::vx},
    {"vy", "velocity half a step earlier",    "m/s", "node_update", &State::vy},
    {"vz", "velocity half a step earlier",    "m/s", "node_update", &State::vz},
    // clang-format on
};

/// 64-bit FNV-1a over the step number and the bits of every node field: for each field in the table's order,
/// for each node in the user's numbering, the eight bytes of the double from the least significant one.
std::uint64_t state_hash(const State& state);

}  // namespace cinch
