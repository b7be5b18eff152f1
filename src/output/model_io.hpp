// ResultModel <-> the parts of the result file that do not change during a run.
#pragma once
#include "base/result.hpp"
#include "output/hdf5_file.hpp"

namespace cinch {

/// Writes mesh, parts, rings, balls, masses, probe columns and the program's own description.
void write_model(h5::File& file, const ResultModel& model);

/// Throws FileError when the file is not a Cinch result or damaged.
ResultModel read_model(const h5::File& file);

/// The doubles of a list of vectors, one after the other.
std::span<const double> flat(const std::vector<Vec3>& vectors);
std::span<double> flat(std::vector<Vec3>& vectors);

}  // namespace cinch
