// How far the elements of a part are stretched when they begin.
#pragma once
#include <string>
#include <vector>

#include "scene/assembly.hpp"

namespace cinch {

/// What begins with more strain than this was hardly meant to be so short.
inline constexpr double great_laid_strain = 0.05;

/// The greatest of a part.
struct BeginStrain {
  Index part = 0;
  Index element = 0;    ///< of all, the first that has it
  double strain = 0;    ///< where it is that of a closing thread: as laid along what is unstretched by then
  std::string on = {};  ///< the node that its element shares away from where its thread would end; or empty
  double gap = 0;       ///< from there to that node, m
};

/// Of parts that begin with more than great_laid_strain, in order; closing threads whose length alone says so
/// (LaidThread::strain) left out. Needs nodes and elements as they begin.
std::vector<BeginStrain> great_begin_strains(const Scene& scene, const Assembly& assembly);

}  // namespace cinch
