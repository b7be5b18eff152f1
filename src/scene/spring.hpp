// The spring-damper that stands for a piece of thread: from material, length and diameter to its constants.
#pragma once
#include "scene/assembly.hpp"

namespace cinch {

/// An element with its ends left open: those of a part are all alike.
struct Spring {
  AssemblyElement element;
  double mass = 0;  ///< kg
};

/// Throws CaseError at `source` where the constants come out as no numbers to compute with.
Spring spring_of(double rest_length, double diameter, const Material& material, Index part,
                 const SourceRef& source);

/// h of eq. (8), 1/Pa.
double compliance(double youngs_modulus, double poissons_ratio);

}  // namespace cinch
