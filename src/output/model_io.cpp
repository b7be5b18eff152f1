#include "output/model_io.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "output/result_layout.hpp"

namespace cinch {
namespace {

using namespace layout;
using std::string;

// One member of a list of structures as an array of its own.
template <class T, class Item, class Get>
std::vector<T> column(const std::vector<Item>& items, Get get) {
  std::vector<T> values;
  values.reserve(items.size());
  for (const Item& item : items) values.push_back(get(item));
  return values;
}

template <class T>
void write_column(h5::File& file, const string& name, const std::vector<T>& values,
                  std::string_view unit = {}) {
  file.write<T>(name, values, {values.size()}, unit);
}

// Reads a column that belongs to a list of known length.
template <class T>
std::vector<T> read_column(const h5::File& file, const string& name, std::size_t length) {
  auto values = file.read<T>(name);
  if (values.size() != length) file.fail("use " + name + " (unexpected length)");
  return values;
}

std::vector<string> read_text_column(const h5::File& file, const string& name, std::size_t length) {
  auto values = file.read_texts(name);
  if (values.size() != length) file.fail("use " + name + " (unexpected length)");
  return values;
}

void write_mesh(h5::File& file, const ResultModel& model) {
  const auto elements = static_cast<std::int64_t>(model.elements.size());
  const auto nodes = static_cast<std::int64_t>(model.node_mass.size());
  const std::int64_t version[] = {2, 0};
  file.set_attribute(kVtk, "Version", version);
  file.set_ascii_attribute(kVtk, "Type", "UnstructuredGrid");

  std::vector<std::int64_t> connectivity, offsets{0};
  for (const auto& ends : model.elements) {
    connectivity.insert(connectivity.end(), {ends[0], ends[1]});
    offsets.push_back(offsets.back() + 2);
  }
  constexpr std::uint8_t kVtkLine = 3;
  write_column(file, kConnectivity, connectivity);
  write_column(file, "/VTKHDF/Offsets", offsets);
  write_column(file, "/VTKHDF/Types", std::vector<std::uint8_t>(model.elements.size(), kVtkLine));
  write_column<std::int64_t>(file, "/VTKHDF/NumberOfPoints", {nodes});
  write_column<std::int64_t>(file, "/VTKHDF/NumberOfCells", {elements});
  write_column<std::int64_t>(file, "/VTKHDF/NumberOfConnectivityIds", {2 * elements});
  write_column(file, kPart, model.element_part);
  write_column(file, "/cinch/elements/rest_length", model.rest_length, "m");
  write_column(file, "/cinch/elements/radius", model.element_radius, "m");
  write_column(file, "/cinch/nodes/mass", model.node_mass, "kg");
}

void write_description(h5::File& file, const ResultModel& model) {
  file.set_attribute(kCinch, "format", kFormat);
  file.set_attribute(kCinch, "format_version", std::int64_t{kFormatVersion});
  file.set_attribute(kCinch, "case", model.case_name);
  file.set_attribute(kCinch, "version", model.version);
  file.set_attribute(kCinch, "commit", model.commit);
  file.set_attribute(kCinch, "compiler", model.compiler);
  file.set_attribute(kCinch, "isa", model.isa);
  file.set_attribute(kCinch, "threads", std::int64_t{model.threads});
  file.set_attribute(kCinch, "time_step", model.time_step);
  file.set_attribute(kCinch, "closing_time_step", model.closing_time_step);
  if (model.closing_time) file.set_attribute(kCinch, "closing_time", *model.closing_time);
  // Data sets, because an attribute holds no more than 64 kB.
  file.write_text("/cinch/title", model.title);
  file.write_text("/cinch/about", model.about);
  file.write_text("/cinch/case_toml", model.case_toml);
}

void write_parts(h5::File& file, const ResultModel& model) {
  const string parts = kParts, rings = kRings, balls = kBalls, masses = kMasses;
  file.write_texts(parts + "/name", column<string>(model.parts, [](auto& p) { return p.name; }));
  file.write_texts(parts + "/kind", column<string>(model.parts, [](auto& p) { return p.kind; }));
  write_column(file, parts + "/closing",
               column<std::uint8_t>(model.parts, [](auto& p) { return p.closing; }));

  file.write_texts(rings + "/name", column<string>(model.rings, [](auto& r) { return r.name; }));
  write_column(file, rings + "/radius", column<double>(model.rings, [](auto& r) { return r.radius; }), "m");
  write_column(file, rings + "/wire_radius",
               column<double>(model.rings, [](auto& r) { return r.wire_radius; }), "m");

  const string joints = kJoints;
  write_column(file, joints + "/part", column<std::int32_t>(model.joints, [](auto& j) { return j.part; }));
  write_column(file, joints + "/ring", column<std::int32_t>(model.joints, [](auto& j) { return j.ring; }));

  file.write_texts(balls + "/name", column<string>(model.balls, [](auto& b) { return b.name; }));
  const auto centers = column<Vec3>(model.balls, [](auto& b) { return b.center; });
  file.write<double>(balls + "/center", flat(centers), {centers.size(), 3}, "m");
  write_column(file, balls + "/radius", column<double>(model.balls, [](auto& b) { return b.radius; }), "m");

  file.write_texts(masses + "/name", column<string>(model.masses, [](auto& m) { return m.name; }));
  write_column(file, masses + "/node", column<std::int32_t>(model.masses, [](auto& m) { return m.node; }));
  write_column(file, masses + "/mass", column<double>(model.masses, [](auto& m) { return m.mass; }), "kg");
}

void write_probe_columns(h5::File& file, const ResultModel& model) {
  const string probes = kProbes;
  file.write_texts(probes + "/name", column<string>(model.probes, [](auto& p) { return p.name; }));
  file.write_texts(probes + "/quantity", column<string>(model.probes, [](auto& p) { return p.quantity; }));
  file.write_texts(probes + "/of", column<string>(model.probes, [](auto& p) { return p.of; }));
  file.write_texts(probes + "/unit", column<string>(model.probes, [](auto& p) { return p.unit; }));
}

void check_format(const h5::File& file) {
  const bool ours = file.exists(kCinch) && file.has_attribute(kCinch, "format") &&
                    file.text_attribute(kCinch, "format") == kFormat;
  if (!ours) throw FileError(file.path().string() + ": not a Cinch result");
  const auto version = file.integer_attribute(kCinch, "format_version");
  if (version != kFormatVersion) {
    throw FileError(file.path().string() + ": result format " + std::to_string(version) +
                    "; this program reads format " + std::to_string(kFormatVersion));
  }
}

void read_description(const h5::File& file, ResultModel& model) {
  model.case_name = file.text_attribute(kCinch, "case");
  model.version = file.text_attribute(kCinch, "version");
  model.commit = file.text_attribute(kCinch, "commit");
  model.compiler = file.text_attribute(kCinch, "compiler");
  model.isa = file.text_attribute(kCinch, "isa");
  model.threads = static_cast<int>(file.integer_attribute(kCinch, "threads"));
  model.time_step = model.closing_time_step = file.real_attribute(kCinch, "time_step");
  if (file.has_attribute(kCinch, "closing_time_step"))  // older results have none
    model.closing_time_step = file.real_attribute(kCinch, "closing_time_step");
  if (file.has_attribute(kCinch, "closing_time")) {
    model.closing_time = file.real_attribute(kCinch, "closing_time");
  }
  model.title = file.read_text("/cinch/title");
  model.about = file.read_text("/cinch/about");
  model.case_toml = file.read_text("/cinch/case_toml");
}

void read_mesh(const h5::File& file, ResultModel& model) {
  const auto connectivity = file.read<std::int64_t>(kConnectivity);
  model.node_mass = file.read<double>("/cinch/nodes/mass");
  const auto nodes = static_cast<std::int64_t>(model.node_mass.size());
  for (std::size_t i = 0; i + 1 < connectivity.size(); i += 2) {
    const auto a = connectivity[i], b = connectivity[i + 1];
    if (std::min(a, b) < 0 || std::max(a, b) >= nodes) file.fail("use its connectivity (no such node)");
    model.elements.push_back({static_cast<Index>(a), static_cast<Index>(b)});
  }
  const std::size_t elements = model.elements.size();
  model.rest_length = read_column<double>(file, "/cinch/elements/rest_length", elements);
  model.element_radius = read_column<double>(file, "/cinch/elements/radius", elements);
  model.element_part = read_column<std::int32_t>(file, kPart, elements);
}

void read_parts(const h5::File& file, ResultModel& model) {
  const auto names = file.read_texts(string(kParts) + "/name");
  const auto kinds = read_text_column(file, string(kParts) + "/kind", names.size());
  const auto closing = read_column<std::uint8_t>(file, string(kParts) + "/closing", names.size());
  for (std::size_t i = 0; i < names.size(); ++i) model.parts.push_back({kinds[i], names[i], closing[i] != 0});
  const auto count = static_cast<int>(names.size());
  for (const int part : model.element_part) {
    if (part < 0 || part >= count) file.fail("use its element parts (no such part)");
  }
}

void read_joints(const h5::File& file, ResultModel& model) {
  if (!file.exists(kJoints)) return;  // of earlier versions
  const auto part = file.read<std::int32_t>(string(kJoints) + "/part");
  const auto ring = read_column<std::int32_t>(file, string(kJoints) + "/ring", part.size());
  const auto parts = static_cast<int>(model.parts.size()), rings = static_cast<int>(model.rings.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (std::min(part[i], ring[i]) < 0 || part[i] >= parts || ring[i] >= rings)
      file.fail("use its joints (no such thread or ring)");
    model.joints.push_back({part[i], ring[i]});
  }
}

void read_bodies(const h5::File& file, ResultModel& model) {
  const auto rings = file.read_texts(string(kRings) + "/name");
  const auto ring_radius = read_column<double>(file, string(kRings) + "/radius", rings.size());
  const auto wire_radius = read_column<double>(file, string(kRings) + "/wire_radius", rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    model.rings.push_back({rings[i], ring_radius[i], wire_radius[i]});
  }
  const auto balls = file.read_texts(string(kBalls) + "/name");
  const auto center = read_column<double>(file, string(kBalls) + "/center", 3 * balls.size());
  const auto radius = read_column<double>(file, string(kBalls) + "/radius", balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    model.balls.push_back({balls[i], {center[3 * i], center[3 * i + 1], center[3 * i + 2]}, radius[i]});
  }
  const auto masses = file.read_texts(string(kMasses) + "/name");
  const auto node = read_column<std::int32_t>(file, string(kMasses) + "/node", masses.size());
  const auto mass = read_column<double>(file, string(kMasses) + "/mass", masses.size());
  for (std::size_t i = 0; i < masses.size(); ++i) model.masses.push_back({masses[i], node[i], mass[i]});
}

void read_probe_columns(const h5::File& file, ResultModel& model) {
  const auto names = file.read_texts(string(kProbes) + "/name");
  const auto quantity = read_text_column(file, string(kProbes) + "/quantity", names.size());
  const auto of = read_text_column(file, string(kProbes) + "/of", names.size());
  const auto unit = read_text_column(file, string(kProbes) + "/unit", names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    model.probes.push_back({names[i], quantity[i], of[i], unit[i]});
  }
}

}  // namespace

std::span<const double> flat(const std::vector<Vec3>& vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return vectors.empty() ? std::span<const double>() : std::span(vectors[0].data(), 3 * vectors.size());
}

std::span<double> flat(std::vector<Vec3>& vectors) {
  return vectors.empty() ? std::span<double>() : std::span(vectors[0].data(), 3 * vectors.size());
}

void write_model(h5::File& file, const ResultModel& model) {
  write_description(file, model);
  write_mesh(file, model);
  write_parts(file, model);
  write_probe_columns(file, model);
}

ResultModel read_model(const h5::File& file) {
  check_format(file);
  ResultModel model;
  read_description(file, model);
  read_mesh(file, model);
  read_parts(file, model);
  read_bodies(file, model);
  read_joints(file, model);
  read_probe_columns(file, model);
  return model;
}

}  // namespace cinch
