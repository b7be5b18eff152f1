// Three-vectors for set-up, output and tests. Kernels use plain x, y, z arrays instead.
#pragma once
#include <Eigen/Dense>

#include "base/index.hpp"

namespace cinch {
using Vec3 = Eigen::Vector3d;
}  // namespace cinch
