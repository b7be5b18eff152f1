// Cinch as a library: one header for programs that build scenes, run them and read results.
//
//   const cinch::Scene scene = cinch::read_case("capture.toml", {{"closing.time_s", "1.4"}});
//   cinch::Simulation simulation(scene);
//   simulation.advance_to(simulation.preparation().end_step);
//   const cinch::Frame frame = simulation.frame();      // positions, velocities, tensions, ring forces,
//   energies const cinch::Summary summary = simulation.summary();  // residual, momentum drift, events, rings
//
// Errors are exceptions of type cinch::Error; each carries the exit code that the program would return.
#pragma once
#include "base/error.hpp"            // Error, CaseError, NumericalError, FileError
#include "input/case_reader.hpp"     // read_case, parse_case
#include "output/recorder.hpp"       // Recorder: frames and probes to disk
#include "output/result_reader.hpp"  // Result: read them back
#include "plan/simulation.hpp"       // Simulation
#include "scene/scene.hpp"           // Scene and its parts
