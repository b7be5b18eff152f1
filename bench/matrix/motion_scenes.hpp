// The scenes of the matrix' motion group.
#pragma once
#include "scenes.hpp"

namespace cinch::matrix {

// ---- impacts: what flies has gone 1 mm, or touches at once where it is slow

Scene mass_on_ball(double speed);         ///< the end mass of a thread that trails behind
Scene thread_on_ball(double speed);       ///< its middle
Scene mass_on_wire(double speed);         ///< along the ring's axis, at the wire's middle
Scene mass_on_rim(double speed);          ///< in the ring's plane
Scene thread_in_ring(double speed);       ///< that goes through the opening
Scene thread_outside_ring(double speed);  ///< that comes from without

// ---- places

Scene thread_on_axis();      ///< through the centre, along the axis, stretched, shaken along itself
Scene thread_across_ring();  ///< in the ring's plane, through its centre
Scene thread_in_plane();     ///< in the ring's plane, towards its rim
Scene two_rings();           ///< side by side, one thread lies on both
Scene ring_neighbours();     ///< on elements side by side, a thread through both
Scene ring_at_end();         ///< on the last element of a thread, another goes through it
Scene short_elements();      ///< of 0.2 mm at a wire of 4 mm
Scene long_elements();       ///< of 0.1 m at a ring of 20 mm
Scene wire_at_rest();        ///< thread and wire just touch
Scene wire_pressed();        ///< they overlap by a micrometre
Scene ball_at_rest();        ///< mass and ball just touch
Scene idle_thread();         ///< slack, at rest: no energy at all

Scene folded_net(double factor);  ///< all knots within its size times that; its corners fly apart
Scene folded_ringed_net();
Scene closing_net(double time);  ///< an edge that a thread with two thrown masses closes, s

/// A stowed net with a mechanism at a corner that sheds its masses at that time, s, and a closing thread.
Scene separating_net(double time);

/// A net with a mass of 1 kg at each corner, pressed on a ball at 2 m/s.
Scene net_on_ball(double modulus, int elements_per_side, double alpha);

// ---- known to win energy

Scene node_beside_rim(double damping, double fraction);  ///< taut over a rim, 0.01 mm from a light node
Scene end_into_ring(double end_mass, double fraction);   ///< a thread drawn through a ring until its end

}  // namespace cinch::matrix
