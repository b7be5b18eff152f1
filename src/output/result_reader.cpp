#include "output/result_reader.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "output/hdf5_file.hpp"
#include "output/model_io.hpp"
#include "output/result_layout.hpp"
#include "output/summary_json.hpp"

namespace cinch {
namespace {

using namespace layout;

std::filesystem::path find_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw FileError(path.string() + ": no such file or directory");
  if (!std::filesystem::is_directory(path, error)) return path;
  if (!std::filesystem::exists(path / kResultFile, error)) {
    throw FileError(path.string() + ": no " + kResultFile + " in this directory");
  }
  return path / kResultFile;
}

/// Frames of which every array is there. The counter alone should do; a writer that was killed may have left
/// less.
int complete_frames(const h5::File& file, const ResultModel& model) {
  auto frames = static_cast<hsize_t>(std::max<std::int64_t>(file.integer_attribute(kSteps, kFrameCount), 0));
  auto limit = [&](const std::string& name, std::size_t rows) {
    if (rows > 0) frames = std::min(frames, file.shape(name).at(0) / rows);
  };
  for (const char* name : {kPoints, kVelocity, kContactForce}) limit(name, model.node_mass.size());
  for (const char* name : {kTension, kStrain, kActive}) limit(name, model.elements.size());
  if (!model.rings.empty()) {
    for (const char* name : {kRingCenter, kRingNormal, kRingForce}) limit(name, 1);
  }
  if (!model.joints.empty())
    for (const char* name : {kJointElement, kJointWaypoint}) limit(name, 1);
  for (const std::string& term : Energies::names()) limit(kEnergy + term, 1);
  limit(kTimes, 1);
  limit(kStepNumbers, 1);
  return static_cast<int>(frames);
}

hsize_t complete_rows(const h5::File& file, const ResultModel& model) {
  if (model.probes.empty()) return 0;
  const auto rows =
      static_cast<hsize_t>(std::max<std::int64_t>(file.integer_attribute(kProbes, kRowCount), 0));
  return std::min({rows, file.shape(kProbeTimes).at(0), file.shape(kProbeValues).at(0)});
}

template <class T>
std::vector<T> first_rows(const h5::File& file, const std::string& name, hsize_t count) {
  std::vector<T> values(count);
  file.read_rows<T>(name, 0, count, values);
  return values;
}

std::optional<Summary> find_summary(const h5::File& file) {
  if (file.exists(kSummary)) {
    return summary_from_json(file.read_text(kSummary), file.path().string() + ":" + kSummary);
  }
  const auto beside = file.path().parent_path() / kSummaryFile;
  std::error_code error;
  if (!std::filesystem::exists(beside, error)) return std::nullopt;
  return read_summary(beside);
}

}  // namespace

struct Result::Impl {
  h5::File file;
  ResultModel model;
  int frames = 0;
  hsize_t rows = 0;
  std::vector<double> times;
  std::vector<std::int64_t> steps;
  std::string run_id;
  std::optional<Summary> summary;

  explicit Impl(const std::filesystem::path& path) : file(h5::File::open(path)), model(read_model(file)) {
    frames = complete_frames(file, model);
    rows = complete_rows(file, model);
    times = first_rows<double>(file, kTimes, static_cast<hsize_t>(frames));
    steps = first_rows<std::int64_t>(file, kStepNumbers, static_cast<hsize_t>(frames));
    if (file.has_attribute(kCinch, kRunId)) run_id = file.text_attribute(kCinch, kRunId);
    summary = find_summary(file);
  }

  /// Frame k of an array with `rows` rows a frame.
  template <class T>
  void read(const char* name, int k, std::size_t rows_a_frame, std::span<T> into) const {
    file.read_rows<T>(name, static_cast<hsize_t>(k) * rows_a_frame, rows_a_frame, into);
  }
  std::vector<Vec3> vectors(const char* name, int k, std::size_t count) const {
    std::vector<Vec3> list(count);
    if (count > 0) read<double>(name, k, count, flat(list));
    return list;
  }
  /// Row k of an array with `count` vectors in a row.
  std::vector<Vec3> vector_row(const char* name, int k, std::size_t count) const {
    std::vector<Vec3> list(count);
    if (!list.empty()) read<double>(name, k, 1, flat(list));
    return list;
  }
  double energy_term(const std::string& term, int k) const {
    double value = 0;
    file.read_rows<double>(kEnergy + term, static_cast<hsize_t>(k), 1, {&value, 1});
    return value;
  }
  std::vector<std::string>::difference_type column(const std::string& name) const {
    const auto found = std::find_if(model.probes.begin(), model.probes.end(),
                                    [&](auto& probe) { return probe.name == name; });
    return found == model.probes.end() ? -1 : found - model.probes.begin();
  }
};

Result::Result(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(find_file(path))) {}
Result::Result(Result&&) noexcept = default;
Result::~Result() = default;

const ResultModel& Result::model() const { return impl_->model; }
int Result::frames() const { return impl_->frames; }
const std::vector<double>& Result::frame_times() const { return impl_->times; }
const std::vector<std::int64_t>& Result::frame_steps() const { return impl_->steps; }
const std::optional<Summary>& Result::summary() const { return impl_->summary; }
const std::string& Result::run_id() const { return impl_->run_id; }
const std::filesystem::path& Result::path() const { return impl_->file.path(); }

Frame Result::frame(int k) const {
  if (k < 0 || k >= frames()) {
    throw FileError(path().string() + ": has no frame " + std::to_string(k) + " (" +
                    std::to_string(frames()) + " frames)");
  }
  const std::size_t nodes = model().node_mass.size(), elements = model().elements.size();
  const std::size_t rings = model().rings.size(), joints = model().joints.size();
  Frame frame;
  frame.time = impl_->times[static_cast<std::size_t>(k)];
  frame.step = impl_->steps[static_cast<std::size_t>(k)];
  frame.position = impl_->vectors(kPoints, k, nodes);
  frame.velocity = impl_->vectors(kVelocity, k, nodes);
  frame.contact_force = impl_->vectors(kContactForce, k, nodes);
  frame.tension.resize(elements);
  frame.strain.resize(elements);
  frame.active.resize(elements);
  impl_->read<double>(kTension, k, elements, frame.tension);
  impl_->read<double>(kStrain, k, elements, frame.strain);
  impl_->read<std::uint8_t>(kActive, k, elements, frame.active);
  frame.ring_center = impl_->vector_row(kRingCenter, k, rings);
  frame.ring_normal = impl_->vector_row(kRingNormal, k, rings);
  frame.ring_force = impl_->vector_row(kRingForce, k, rings);
  frame.joint_element.resize(joints);
  if (joints > 0) impl_->read<Index>(kJointElement, k, 1, frame.joint_element);
  frame.joint_waypoint = impl_->vector_row(kJointWaypoint, k, joints);
  std::vector<double> terms;
  for (const std::string& term : Energies::names()) terms.push_back(impl_->energy_term(term, k));
  frame.energy = Energies::from_values(terms);
  return frame;
}

std::vector<Energies> Result::energies() const {
  const auto count = static_cast<std::size_t>(frames());
  std::vector<std::vector<double>> rows(count);
  for (const std::string& term : Energies::names()) {
    const auto values = first_rows<double>(impl_->file, kEnergy + term, count);
    for (std::size_t k = 0; k < count; ++k) rows[k].push_back(values[k]);
  }
  std::vector<Energies> list;
  for (const auto& row : rows) list.push_back(Energies::from_values(row));
  return list;
}

std::vector<double> Result::probe_times() const {
  if (model().probes.empty()) return {};
  return first_rows<double>(impl_->file, kProbeTimes, impl_->rows);
}

std::vector<double> Result::probe_rows(std::size_t count) const {
  std::vector<double> table(count * model().probes.size());
  impl_->file.read_rows<double>(kProbeValues, 0, count, table);
  return table;
}

bool Result::has_probe(const std::string& name) const { return impl_->column(name) >= 0; }

std::vector<double> Result::probe(const std::string& name) const {
  const auto column = impl_->column(name);
  if (column < 0) {
    std::string known;
    for (const auto& probe : model().probes) known += (known.empty() ? "" : ", ") + probe.name;
    throw FileError(path().string() + ": has no probe column '" + name +
                    "' (there are: " + (known.empty() ? "none" : known) + ")");
  }
  const std::size_t width = model().probes.size();
  const std::vector<double> table = probe_rows(impl_->rows);
  std::vector<double> values(impl_->rows);
  for (std::size_t row = 0; row < values.size(); ++row) {
    values[row] = table[row * width + static_cast<std::size_t>(column)];
  }
  return values;
}

}  // namespace cinch
