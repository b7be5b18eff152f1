#include "report/digest.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>

#include "base/error.hpp"
#include "input/case_reader.hpp"
#include "scene/mouth.hpp"

namespace cinch {
namespace {

bool starts_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// All probes, read at once: each look into the file would read all of them again.
class ProbeTable {
 public:
  explicit ProbeTable(const Result& result) : columns(result.model().probes), times(result.probe_times()) {
    if (!columns.empty()) rows_ = result.probe_rows(times.size());
  }
  Series series(std::size_t column) const {
    Series out{times, std::vector<double>(times.size())};
    for (std::size_t row = 0; row < times.size(); ++row) out.v[row] = rows_[row * columns.size() + column];
    return out;
  }
  std::vector<double> values(const std::string& name) const {
    const auto found = std::find_if(columns.begin(), columns.end(), [&](auto& c) { return c.name == name; });
    return series(static_cast<std::size_t>(found - columns.begin())).v;
  }

  const std::vector<ResultModel::ProbeColumn>& columns;
  const std::vector<double> times;

 private:
  std::vector<double> rows_;
};

/// The columns of one probe: a scalar, or the components x, y, z.
struct Columns {
  std::string scalar;
  std::array<std::string, 3> part;
  bool vector() const { return !part[0].empty() && !part[1].empty() && !part[2].empty(); }
};

// -1: a scalar; else 0, 1, 2 for names that end in .x, .y, .z.
int component_of(const std::string& name) {
  if (name.size() < 2 || name[name.size() - 2] != '.') return -1;
  const auto axis = std::string("xyz").find(name.back());
  return axis == std::string::npos ? -1 : static_cast<int>(axis);
}

Columns find_columns(const ProbeTable& probes, const std::string& quantity,
                     const std::vector<std::string>& of) {
  Columns found;
  for (const auto& column : probes.columns) {
    const bool same = column.quantity == quantity || starts_with(column.quantity, quantity + ".");
    if (!same || std::find(of.begin(), of.end(), column.of) == of.end()) continue;
    const int axis = component_of(column.name);
    (axis < 0 ? found.scalar : found.part[static_cast<std::size_t>(axis)]) = column.name;
  }
  return found;
}

void take_vector(const ProbeTable& probes, const std::string& quantity, const std::vector<std::string>& of,
                 VectorSeries& into) {
  const Columns columns = find_columns(probes, quantity, of);
  if (!columns.vector()) return;
  const auto x = probes.values(columns.part[0]), y = probes.values(columns.part[1]),
             z = probes.values(columns.part[2]);
  if (x.empty()) return;
  into = {probes.times, {}, "probe"};
  for (std::size_t i = 0; i < x.size(); ++i) into.v.emplace_back(x[i], y[i], z[i]);
}

// A displacement counts from the first frame's position.
void take_displacement(const ProbeTable& probes, const std::vector<std::string>& of, VectorSeries& into) {
  if (into.empty()) return;
  const Vec3 start = into.v.front();
  VectorSeries moved;
  take_vector(probes, "displacement", of, moved);
  if (moved.empty()) return;
  for (Vec3& value : moved.v) value += start;
  into = std::move(moved);
}

void take_scalar(const ProbeTable& probes, const std::string& quantity, Series& into) {
  for (std::size_t k = 0; k < probes.columns.size(); ++k) {
    if (probes.columns[k].quantity != quantity) continue;
    if (!probes.times.empty()) into = probes.series(k);
    return;
  }
}

void append(VectorSeries& series, double time, const Vec3& value) {
  series.t.push_back(time);
  series.v.push_back(value);
}

void append(Series& series, double time, double value) {
  series.t.push_back(time);
  series.v.push_back(value);
}

void add_frame(const Frame& frame, Digest& d) {
  for (std::size_t r = 0; r < d.model.rings.size(); ++r) {
    append(d.ring_position[r], frame.time, frame.ring_center[r]);
    append(d.ring_force[r], frame.time, frame.ring_force[r]);
  }
  for (std::size_t m = 0; m < d.model.masses.size(); ++m) {
    const auto node = static_cast<std::size_t>(d.model.masses[m].node);
    append(d.mass_position[m], frame.time, frame.position[node]);
    append(d.mass_velocity[m], frame.time, frame.velocity[node]);
  }
  const bool net = std::any_of(d.model.parts.begin(), d.model.parts.end(),
                               [](const auto& part) { return part.kind == "net"; });  // else no mouth
  if (net && d.model.rings.size() >= 2) append(d.mouth_spread, frame.time, mouth_spread(frame.ring_center));
  if (net && d.model.rings.size() >= 3) append(d.mouth_area, frame.time, mouth_area(frame.ring_center));
  double tension = 0;
  for (const double value : frame.tension) tension = std::max(tension, value);
  append(d.peak_tension, frame.time, tension);
}

void read_frames(const Result& result, Digest& d) {
  d.ring_position.assign(d.model.rings.size(), {{}, {}, "frames"});
  d.ring_force = d.ring_position;
  d.mass_position.assign(d.model.masses.size(), {{}, {}, "frames"});
  d.mass_velocity = d.mass_position;
  for (int k = 0; k < result.frames(); ++k) {
    const Frame frame = result.frame(k);
    if (k == 0)
      for (const Vec3& v : frame.velocity) d.start_speed = std::max(d.start_speed, v.norm());
    add_frame(frame, d);
  }
}

// A probe is finer in time than the frames and takes their place.
void read_probes(const Result& result, Digest& d) {
  const ProbeTable probes(result);
  for (std::size_t r = 0; r < d.model.rings.size(); ++r) {
    const std::vector<std::string> of{"ring." + d.model.rings[r].name, d.model.rings[r].name};
    take_displacement(probes, of, d.ring_position[r]);
    take_vector(probes, "position", of, d.ring_position[r]);
    take_vector(probes, "force", of, d.ring_force[r]);
  }
  for (std::size_t m = 0; m < d.model.masses.size(); ++m) {
    take_displacement(probes, {d.model.masses[m].name}, d.mass_position[m]);
    take_vector(probes, "position", {d.model.masses[m].name}, d.mass_position[m]);
    take_vector(probes, "velocity", {d.model.masses[m].name}, d.mass_velocity[m]);
  }
  take_scalar(probes, "mouth_area", d.mouth_area);
  take_scalar(probes, "mouth_spread", d.mouth_spread);
  constexpr std::size_t points = 1500;  // of a curve among many
  for (std::size_t k = 0; k < probes.columns.size(); ++k)
    if (probed_quantity(probes.columns[k]) != "energy")
      d.probes.push_back({probes.columns[k], thinned(probes.series(k), points)});
}

// The resolved case is a case file; another version may have written what this one does not read.
void read_resolved_case(Digest& d) {
  try {
    const Scene scene = parse_case(d.model.case_toml, d.model.case_name + ".toml");
    d.gravity = scene.gravity && scene.gravity->norm() > 0 ? scene.gravity : std::nullopt;
    d.look_interval = scene.output.sample_interval();
    const Recognised scene_is = recognise(scene);
    d.paper_case = scene_is.as;
    if (!scene_is.difference.empty()) d.unjudged = "not the paper's scene: " + scene_is.difference;
  } catch (const CaseError&) {
    d.unjudged = "not compared with the paper: this version does not read the case in the result";
  }
}

}  // namespace

std::string probed_quantity(const ResultModel::ProbeColumn& column) {
  return column.quantity.substr(0, column.quantity.find('.'));
}

int Digest::mass(const std::string& name) const {
  for (std::size_t m = 0; m < model.masses.size(); ++m)
    if (model.masses[m].name == name || ends_with(model.masses[m].name, "." + name))
      return static_cast<int>(m);
  return -1;
}

int Digest::ring(const std::string& name) const {
  for (std::size_t r = 0; r < model.rings.size(); ++r) {
    std::string digits = model.rings[r].name;
    if (digits == name) return static_cast<int>(r);
    digits.erase(digits.begin(),
                 std::find_if(digits.begin(), digits.end(), [](char c) { return c >= '1' && c <= '9'; }));
    if (!digits.empty() && digits == name) return static_cast<int>(r);
  }
  return -1;
}

const RingRecord* Digest::record(int ring) const {
  if (!summary || ring < 0) return nullptr;
  const std::string& name = model.rings[static_cast<std::size_t>(ring)].name;
  for (const RingRecord& entry : summary->ring_records)
    if (entry.name == name) return &entry;
  return nullptr;
}

std::optional<double> Digest::first_event(const std::string& kind) const {
  if (!summary) return std::nullopt;
  std::optional<double> first;
  for (const Event& event : summary->events)
    if (event.kind == kind && (!first || event.time < *first)) first = event.time;
  return first;
}

std::vector<Event> Digest::turns(const std::string& kind, const std::string& undone,
                                 const std::string& name) const {
  std::vector<Event> found;
  if (!summary) return found;
  for (const Event& event : summary->events)
    if ((event.kind == kind || event.kind == undone) && (name.empty() || event.name == name))
      found.push_back(event);
  return found;
}

int Digest::thread_elements() const {
  std::vector<int> count(model.parts.size(), 0);
  for (const int part : model.element_part) ++count[static_cast<std::size_t>(part)];
  int most = 0;
  for (std::size_t p = 0; p < count.size(); ++p)
    if (model.parts[p].kind == "thread") most = std::max(most, count[p]);
  return most;
}

std::string Digest::label() const {
  if (!own_label.empty()) return own_label;
  if (paper_case == PaperCase::ring_pull) return std::to_string(thread_elements()) + " elements";
  if (paper_case == PaperCase::capture && model.closing_time) {
    char text[48];
    std::snprintf(text, sizeof text, "closing at %.3g s", *model.closing_time);
    return text;
  }
  return model.case_name;
}

Digest digest(const Result& result) {
  Digest d;
  d.model = result.model();
  std::erase_if(d.model.masses, [](const auto& mass) { return starts_with(mass.name, "ring."); });
  d.summary = result.summary();
  d.file = std::filesystem::absolute(result.path()).string();
  d.frame_times = result.frame_times();
  d.energies = result.energies();
  read_resolved_case(d);
  read_frames(result, d);
  read_probes(result, d);
  return d;
}

std::vector<Digest> digest_all(const std::vector<Result>& results) {
  std::vector<Digest> all;
  std::map<std::string, int> uses;
  for (const Result& result : results) {
    all.push_back(digest(result));
    ++uses[all.back().label()];
  }
  for (Digest& d : all)
    if (uses[d.label()] > 1) d.own_label = std::filesystem::path(d.file).parent_path().filename().string();
  return all;
}

}  // namespace cinch
