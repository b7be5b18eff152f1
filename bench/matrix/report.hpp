// What the matrix came to: as JSON for the dashboard, as a table for people.
#pragma once
#include <filesystem>

#include "cell.hpp"

namespace cinch::matrix {

struct Judged {
  Cell cell;
  Outcome outcome;
};

struct Count {
  std::string group;
  int held = 0, stopped = 0, failed = 0;
};

/// By group, in the cells' order.
std::vector<Count> counts(const std::vector<Judged>& all);

/// A row of the table on stdout; and what stands above and below.
void print_head();
void print_row(const Judged& one);
void print_counts(const std::vector<Judged>& all);

/// Writes stability.json; throws FileError.
void write(const std::vector<Judged>& all, Extent extent, const std::filesystem::path& folder);

}  // namespace cinch::matrix
