// The largest step at which central differences with lagged damping stay bounded, and what limits it.
//
// With forces -K x - C v(n-1/2) the scheme is stable while dt^2/4 K + dt/2 C <= M (as matrices); for one mode
// that is dt = (2/omega) (sqrt(1 + xi^2) - xi), xi = c omega / (2 k). Elements can be treated one by one if
// each nodal mass is shared out among them: in proportion to their own dt^2/4 k + dt/2 c, element e with ends
// a, b is stable while
//   dt^2/4 (S_a/m_a + S_b/m_b) + dt/2 (C_a/m_a + C_b/m_b) <= 1,   S, C: sums of k, c over the elements at a
//   node.
// This holds for any shape of the net (no direction is assumed) and is sharp for a straight uniform chain.
// Slack members only lower K. A fixed node counts as infinitely heavy.
//
// An element through which rings slide pulls at their hosts, too: its length changes by w for a node's place
// by 1, w = 1 at its ends. In general an element is stable while
//   dt^2/4 sum_i w_i S_i/m_i + dt/2 sum_i w_i C_i/m_i <= 1,   S, C: sums of w k, w c at a node,
// and w at a host that is not slack is bounded for all that the rings can do. As nobody knows which rings
// meet in one element, each element of their thread counts all of them: on the safe side, and next to nothing
// where rings are heavier than its nodes.
//
// Forces of sliding joints that hold for m steps are central differences of step m dt among themselves
// (sliding_joint.cpp). An element of a sliding thread then uses, besides, what the same sums come to with
// m dt and with only the stiffness and damping of such threads in S and C. That leaves open how slow and fast
// forces at one node beat; the energy's books watch over it.
#pragma once
#include <string>
#include <vector>

#include "store/model.hpp"

namespace cinch {

struct StableStep {
  double step = 0;     ///< s; infinite for a scene without elements
  Index element = -1;  ///< number of the element that limits
};

StableStep stable_step(const Model& model);

/// For how many steps of `step` s forces of sliding joints may hold: at most `most`, and so that this uses no
/// more than `share` of what stability allows, nor more than is left. At least 1.
int joint_steps(const Model& model, double step, double share, int most);

/// By node: 1 / (m (1 - u)), u the largest usage at `step` of the elements at the node: what contacts have
/// left, 1/kg. A fixed node has 0. Forces of sliding joints hold for `joint_steps`.
std::vector<double> node_share(const Model& model, double step, int joint_steps);

}  // namespace cinch
