#include "output/xdmf.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

#include "base/markup.hpp"
#include "output/result_layout.hpp"
#include "output/text_file.hpp"

namespace cinch {
namespace {

using namespace layout;
using std::size_t;
using std::string;

constexpr char kHead[] =
    "<?xml version=\"1.0\" ?>\n"
    "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
    "<Xdmf Version=\"3.0\">\n"
    "<Domain>\n";
constexpr char kTail[] = "</Domain>\n</Xdmf>\n";

string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// How an array lies in the HDF5 file: its number type and where it begins.
enum class Kind { real, integer64, integer32, byte };

string data_item(const string& dimensions, Kind kind, const string& path) {
  static constexpr const char* kTypes[] = {
      R"(NumberType="Float" Precision="8")", R"(NumberType="Int" Precision="8")",
      R"(NumberType="Int" Precision="4")", R"(NumberType="UChar" Precision="1")"};
  return "<DataItem Dimensions=\"" + dimensions + "\" Format=\"HDF\" " + kTypes[static_cast<int>(kind)] +
         ">" + path + "</DataItem>";
}

/// Rows k*rows ... (k+1)*rows - 1 of an array [frames*rows, 3] or [frames*rows].
string frame_item(const string& file, const char* path, Kind kind, size_t k, size_t rows, size_t frames,
                  bool vectors) {
  const string r = std::to_string(rows), first = std::to_string(k * rows),
               all = std::to_string(frames * rows);
  const string from = file + ":" + path + "|";
  if (vectors) return data_item(r + " 3", kind, from + first + " 0:1 1:" + r + " 3:" + all + " 3");
  return data_item(r, kind, from + first + ":1:" + r + ":" + all);
}

/// Slab k of an array [frames, rings, 3].
string ring_item(const string& file, const char* path, size_t k, size_t rings, size_t frames) {
  const string r = std::to_string(rings), at = std::to_string(k), all = std::to_string(frames);
  return data_item(r + " 3", Kind::real,
                   file + ":" + path + "|" + at + " 0 0:1 1 1:1 " + r + " 3:" + all + " " + r + " 3");
}

string attribute(const char* name, bool vector, bool on_cells, const string& item) {
  return string("<Attribute Name=\"") + name + "\" AttributeType=\"" + (vector ? "Vector" : "Scalar") +
         "\" Center=\"" + (on_cells ? "Cell" : "Node") + "\">" + item + "</Attribute>\n";
}

string grid_head(const string& name, double time) {
  return "<Grid Name=\"" + name + "\"><Time Value=\"" + number(time) + "\"/>\n";
}

string series_head(const string& name) {
  return "<Grid Name=\"" + escape_markup(name) + "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
}

string points_topology(size_t count) {
  const string n = std::to_string(count);
  string indices;
  for (size_t i = 0; i < count; ++i) indices += (i ? " " : "") + std::to_string(i);
  return "<Topology TopologyType=\"Polyvertex\" NodesPerElement=\"1\" NumberOfElements=\"" + n +
         "\"><DataItem Dimensions=\"" + n + "\" Format=\"XML\" NumberType=\"Int\">" + indices +
         "</DataItem></Topology>\n";
}

string lines_topology(const string& file, const char* path, size_t lines) {
  return "<Topology TopologyType=\"Polyline\" NodesPerElement=\"2\" NumberOfElements=\"" +
         std::to_string(lines) + "\">" +
         data_item(std::to_string(2 * lines), Kind::integer64, file + ":" + path) + "</Topology>\n";
}

string geometry(const string& item) { return "<Geometry GeometryType=\"XYZ\">" + item + "</Geometry>\n"; }

/// A ball as triangles between circles of latitude: node coordinates and node numbers.
struct Sphere {
  std::ostringstream points, triangles;
  int point_count = 0, triangle_count = 0;
};

void add_triangle(Sphere& sphere, int a, int b, int c) {
  sphere.triangles << a << ' ' << b << ' ' << c << '\n';
  ++sphere.triangle_count;
}

void add_ball(Sphere& sphere, const ResultModel::Ball& ball) {
  constexpr int kRows = 18, kColumns = 36;
  const int first = sphere.point_count;
  for (int i = 0; i <= kRows; ++i) {
    const double polar = std::numbers::pi * i / kRows;
    for (int j = 0; j < kColumns; ++j) {
      const double around = 2 * std::numbers::pi * j / kColumns;
      const Vec3 normal(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                        std::cos(polar));
      const Vec3 point = ball.center + ball.radius * normal;
      sphere.points << number(point.x()) << ' ' << number(point.y()) << ' ' << number(point.z()) << '\n';
      ++sphere.point_count;
    }
  }
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < kColumns; ++j) {
      const int a = first + i * kColumns + j, b = first + i * kColumns + (j + 1) % kColumns;
      if (i > 0) add_triangle(sphere, a, a + kColumns, b);
      if (i + 1 < kRows) add_triangle(sphere, b, a + kColumns, b + kColumns);
    }
  }
}

}  // namespace

string net_xdmf(const string& case_name, NetSize net, std::span<const double> times,
                const string& hdf5_name) {
  const size_t nodes = net.nodes, elements = net.elements, frames = times.size();
  const string file = escape_markup(hdf5_name), e = std::to_string(elements);
  const string topology = lines_topology(file, kConnectivity, elements);
  const string part = attribute("part", false, true, data_item(e, Kind::integer32, file + ":" + kPart));
  auto nodal = [&](const char* path, size_t k) {
    return frame_item(file, path, Kind::real, k, nodes, frames, true);
  };
  auto on_elements = [&](const char* path, Kind kind, size_t k) {
    return frame_item(file, path, kind, k, elements, frames, false);
  };
  string text = kHead + series_head(case_name);
  for (size_t k = 0; k < frames; ++k) {
    text += grid_head("net", times[k]) + topology + geometry(nodal(kPoints, k));
    text += attribute("velocity", true, false, nodal(kVelocity, k));
    text += attribute("contact_force", true, false, nodal(kContactForce, k));
    text += attribute("tension", false, true, on_elements(kTension, Kind::real, k));
    text += attribute("strain", false, true, on_elements(kStrain, Kind::real, k));
    text += attribute("active", false, true, on_elements(kActive, Kind::byte, k));
    text += part + "</Grid>\n";
  }
  return text + "</Grid>\n" + kTail;
}

string rings_xdmf(const ResultModel& model, std::span<const double> times, const string& hdf5_name) {
  const size_t rings = model.rings.size(), frames = times.size();
  const string file = escape_markup(hdf5_name), topology = points_topology(rings);
  const string radius = attribute(
      "radius", false, false, data_item(std::to_string(rings), Kind::real, file + ":" + kRings + "/radius"));
  string text = kHead + series_head(model.case_name + " rings");
  for (size_t k = 0; k < frames; ++k) {
    text +=
        grid_head("rings", times[k]) + topology + geometry(ring_item(file, kRingCenter, k, rings, frames));
    text += attribute("force", true, false, ring_item(file, kRingForce, k, rings, frames));
    text += attribute("normal", true, false, ring_item(file, kRingNormal, k, rings, frames));
    text += radius + "</Grid>\n";
  }
  return text + "</Grid>\n" + kTail;
}

string ways_xdmf(const string& case_name, NetSize net, std::span<const double> times,
                 const string& hdf5_name) {
  const size_t points = net.way_points, segments = net.way_segments, frames = times.size();
  const string file = escape_markup(hdf5_name), topology = lines_topology(file, kWayConnectivity, segments);
  const auto on_segments = [&](const char* path, Kind kind, size_t k) {
    return frame_item(file, path, kind, k, segments, frames, false);
  };
  string text = kHead + series_head(case_name + " ways");
  for (size_t k = 0; k < frames; ++k) {
    text += grid_head("ways", times[k]) + topology;
    text += geometry(frame_item(file, kWayPoints, Kind::real, k, points, frames, true));
    text += attribute("tension", false, true, on_segments(kWayTension, Kind::real, k));
    text += attribute("active", false, true, on_segments(kWayActive, Kind::byte, k)) + "</Grid>\n";
  }
  return text + "</Grid>\n" + kTail;
}

string balls_xdmf(const ResultModel& model) {
  Sphere sphere;
  for (const auto& ball : model.balls) add_ball(sphere, ball);
  const string points = std::to_string(sphere.point_count), triangles = std::to_string(sphere.triangle_count);
  return kHead +
         ("<Grid Name=\"balls\">\n<Topology TopologyType=\"Triangle\" NumberOfElements=\"" + triangles) +
         "\"><DataItem Dimensions=\"" + triangles + " 3\" Format=\"XML\" NumberType=\"Int\">\n" +
         sphere.triangles.str() + "</DataItem></Topology>\n" +
         geometry("<DataItem Dimensions=\"" + points +
                  " 3\" Format=\"XML\" NumberType=\"Float\" Precision=\"8\">\n" + sphere.points.str() +
                  "</DataItem>") +
         "</Grid>\n" + kTail;
}

void write_xdmf(const std::filesystem::path& directory, const ResultModel& model, NetSize net,
                std::span<const double> times) {
  if (times.empty()) return;  // ParaView's reader takes an empty series for a broken file
  replace_text_file(directory / kNetXdmfFile, net_xdmf(model.case_name, net, times, kResultFile));
  if (!model.rings.empty()) {
    replace_text_file(directory / kRingsXdmfFile, rings_xdmf(model, times, kResultFile));
  }
  if (!model.joints.empty())
    replace_text_file(directory / kWaysXdmfFile, ways_xdmf(model.case_name, net, times, kResultFile));
  if (!model.balls.empty()) replace_text_file(directory / kBallsXdmfFile, balls_xdmf(model));
}

}  // namespace cinch
