// What the verdict box says of one result, for page and terminal alike.
#pragma once
#include <string>
#include <vector>

#include "report/digest.hpp"

namespace cinch {

struct Fact {
  std::string what;
  double value = 0;
  std::string unit;
  std::string text;   ///< instead of a number
  std::string aside;  ///< "limited by ..."
};

std::vector<Fact> facts_of(const Digest& d);

/// "done", "failed: ...", "no summary: ..."
std::string status_of(const Digest& d);

}  // namespace cinch
