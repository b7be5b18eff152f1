// XDMF beside the result file: lets ParaView before 5.12 (which cannot read the VTKHDF series itself) open
// it.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "base/result.hpp"

namespace cinch {

/// What the arrays of a net are long.
struct NetSize {
  std::size_t nodes = 0, elements = 0;
  std::size_t way_points = 0, way_segments = 0;  ///< of sliding threads, see ways.hpp
};

/// Text of run.xdmf: one grid for each frame, arrays taken from `hdf5_name` by selections in the path (the
/// only form that ParaView's default readers accept). times: s.
std::string net_xdmf(const std::string& case_name, NetSize net, std::span<const double> times,
                     const std::string& hdf5_name);
/// Text of rings.xdmf: ring centres as points with force and normal.
std::string rings_xdmf(const ResultModel& model, std::span<const double> times, const std::string& hdf5_name);
/// Text of ways.xdmf: threads along their ways through the rings.
std::string ways_xdmf(const std::string& case_name, NetSize net, std::span<const double> times,
                      const std::string& hdf5_name);
/// Text of balls.xdmf: the target balls as triangles.
std::string balls_xdmf(const ResultModel& model);

/// Writes DIR/run.xdmf and, where the model has such parts, rings.xdmf, ways.xdmf and balls.xdmf; each
/// replaced at once, so that a viewer never sees half a file. The model's arrays of nodes and elements may be
/// gone. Throws FileError.
void write_xdmf(const std::filesystem::path& directory, const ResultModel& model, NetSize net,
                std::span<const double> times);

}  // namespace cinch
