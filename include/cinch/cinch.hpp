// Cinch as a library: one header for programs that build scenes, run them and read results.
//
//   const cinch::Scene scene = cinch::read_case("capture.toml", {{"closing.time_s", "1.4"}});
//   cinch::Simulation simulation(scene);
//   const cinch::Timeline& timeline = simulation.preparation().timeline;
//   for (double t = 0.01; simulation.step() < simulation.end_step(); t += 0.01) {
//     simulation.advance_to(std::min(timeline.step_at(t), simulation.end_step()));
//     simulation.note_events(simulation.look());   // mouth closed, target enclosed or lost, thread gone
//     simulation.check_energy(simulation.look());  // NumericalError where the books do not balance
//   }
//   const cinch::Frame frame = simulation.frame();        // positions, velocities, tensions, ring forces
//   const cinch::Summary summary = simulation.summary();  // residual, momentum drift, events, rings
//
// Errors are exceptions of type cinch::Error; each carries the exit code that the program would return.
#pragma once
#include "base/error.hpp"            // Error, CaseError, NumericalError, FileError
#include "input/case_reader.hpp"     // read_case, parse_case
#include "output/recorder.hpp"       // Recorder: frames and probes to disk
#include "output/result_reader.hpp"  // Result: read them back
#include "plan/simulation.hpp"       // Simulation
#include "scene/scene.hpp"           // Scene and its parts
