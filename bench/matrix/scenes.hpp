// Short ways to build the matrix' scenes.
#pragma once
#include "scene/scene.hpp"

namespace cinch::matrix {

constexpr double gravity = 9.81;  // m/s^2

/// One material "m" of 1 GPa and 970 kg/m^3, the default damping, and nothing else.
Scene plain_scene();

/// A thread of "m", 2 mm thick, unstretched where it lies. Good until the next one is added.
Thread& add_thread(Scene& scene, const std::string& name, std::vector<Vec3> points, int elements);

/// A ring of 20 mm with a wire of 4 mm, 6 g and 70 GPa, free, with a node of its own.
Ring& add_ring(Scene& scene, const std::string& name, const Vec3& center, const Vec3& normal);

/// A ball of 0.15 m and 2.3 GPa.
BallTarget& add_ball(Scene& scene, const Vec3& center);

/// A net of `columns` x `rows` meshes of 0.1 m, 2 mm thick.
Net& add_net(Scene& scene, int columns, int rows);

/// Holds all knots on the edges of the net.
void fix_edges(Net& net);

/// With a step of so many stable ones; above one it is allowed.
Scene at_fraction(Scene scene, double fraction);

/// Straight, between fixed ends, stretched by 1 %, its nodes shaken so little that nothing turns slack.
Scene tense_chain(int elements, double damping);

/// A net that is stretched by 1 %, held at its edges and shaken.
Scene tense_net(double damping);

/// Six threads of 4 elements, stretched by 1 %, from one knot to fixed ends on three skew lines; shaken.
Scene tense_junction(double damping);

}  // namespace cinch::matrix
