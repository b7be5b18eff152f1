#include "output/recorder.hpp"

#include <fcntl.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "base/error.hpp"
#include "output/descriptor.hpp"
#include "output/folder_lock.hpp"
#include "output/hdf5_file.hpp"
#include "output/model_io.hpp"
#include "output/report_file.hpp"
#include "output/result_layout.hpp"
#include "output/summary_json.hpp"
#include "output/text_file.hpp"
#include "output/ways.hpp"
#include "output/xdmf.hpp"

namespace cinch {
namespace {

using namespace layout;
using Clock = std::chrono::steady_clock;
using Integers = h5::Series<std::int64_t>;
using Reals = h5::Series<double>;
using Bytes = h5::Series<std::uint8_t>;

constexpr hsize_t kLargestPacked = 1 << 20;  // bytes: what HDF5 keeps of a compressed data set in memory
constexpr hsize_t kSmallestPlain = 1 << 17;  // bytes
constexpr hsize_t kLargestPlain = hsize_t{1} << 31;  // bytes: HDF5 takes chunks below 4 GiB
constexpr hsize_t kIndexChunks = 60;                 // a node of its index takes 64
constexpr hsize_t kScalarRows = 1024;                // rows in a chunk of single numbers
constexpr auto kXdmfInterval = std::chrono::seconds(5);
constexpr std::size_t kMostWaiting = 1 << 20;  // bytes of one data set

/// Of so many rows, those in each of as many chunks as one index node has room for.
hsize_t per_chunk(std::int64_t rows) {
  return (static_cast<hsize_t>(std::max<std::int64_t>(rows, 0)) + kIndexChunks - 1) / kIndexChunks;
}

/// Rows in a chunk, for frames of `rows` rows. Compressed: one frame, or an equal part of a large one. Plain:
/// several frames, so that one index node has room for all that are expected (a kill while HDF5 splits a full
/// one can hide earlier frames).
hsize_t chunk_rows(hsize_t rows, hsize_t row_bytes, const Recorder::Options& options) {
  const hsize_t bytes = std::max<hsize_t>(rows * row_bytes, 1);
  if (!options.compress) {
    const hsize_t wanted = std::min(per_chunk(options.frames), kLargestPlain / bytes);
    return rows * std::max<hsize_t>({kSmallestPlain / bytes, wanted, 1});
  }
  const hsize_t pieces = (bytes + kLargestPacked - 1) / kLargestPacked;
  return (rows + pieces - 1) / pieces;
}

h5::SeriesLayout rows_of(std::size_t rows, std::size_t width, std::size_t bytes,
                         const Recorder::Options& options, const char* unit) {
  h5::SeriesLayout layout;
  if (width > 1) layout.row = {width};
  layout.chunk_rows = chunk_rows(rows, width * bytes, options);
  layout.compress = options.compress;
  layout.unit = unit;
  return layout;
}

/// One row of this shape for each frame.
h5::SeriesLayout slabs(h5::Shape row, hsize_t bytes, const Recorder::Options& options, const char* unit) {
  for (const hsize_t length : row) bytes *= length;
  return {std::move(row), chunk_rows(1, bytes, options), options.compress, unit};
}

/// Single numbers, of which `expected` rows may come.
h5::SeriesLayout numbers(std::int64_t expected, const char* unit = "", h5::Shape row = {}) {
  return {std::move(row), std::max(kScalarRows, per_chunk(expected)), false, unit};
}

/// What VTK's reader wants to know of each step. The topology never changes, so that most of it is zero for
/// ever; equal columns are one data set with several names.
struct StepTable {
  StepTable(h5::File& file, std::int64_t frames)
      : times(file, kTimes, numbers(frames, "s")),
        parts(file, "/VTKHDF/Steps/NumberOfParts", numbers(frames)),
        zeros(file, "/VTKHDF/Steps/PartOffsets", numbers(frames)),
        topology(file, "/VTKHDF/Steps/CellOffsets", numbers(frames, "", {1})),
        points(file, "/VTKHDF/Steps/PointOffsets", numbers(frames)),
        cells(file, "/VTKHDF/Steps/CellDataOffsets/tension", numbers(frames)) {
    file.create_link("/VTKHDF/Steps/CellOffsets", "/VTKHDF/Steps/ConnectivityIdOffsets");
    file.create_link("/VTKHDF/Steps/PointOffsets", "/VTKHDF/Steps/PointDataOffsets/velocity");
    file.create_link("/VTKHDF/Steps/PointOffsets", "/VTKHDF/Steps/PointDataOffsets/contact_force");
    file.create_link("/VTKHDF/Steps/CellDataOffsets/tension", "/VTKHDF/Steps/CellDataOffsets/strain");
    file.create_link("/VTKHDF/Steps/CellDataOffsets/tension", "/VTKHDF/Steps/CellDataOffsets/active");
    file.create_link("/VTKHDF/Steps/PartOffsets", "/VTKHDF/Steps/CellDataOffsets/part");
  }
  void append(double time, std::int64_t point_offset, std::int64_t cell_offset) {
    times.append(time);
    parts.append(1);
    zeros.append(0);
    topology.append(0);
    points.append(point_offset);
    cells.append(cell_offset);
  }
  void hand_over() { h5::hand_over(times, parts, zeros, topology, points, cells); }
  Reals times;
  Integers parts, zeros, topology, points, cells;
};

/// Nodes and elements, frame by frame.
struct NetSeries {
  NetSeries(h5::File& file, std::size_t nodes, std::size_t elements, const Recorder::Options& options)
      : position(file, kPoints, rows_of(nodes, 3, 8, options, "m")),
        velocity(file, kVelocity, rows_of(nodes, 3, 8, options, "m/s")),
        contact_force(file, kContactForce, rows_of(nodes, 3, 8, options, "N")),
        tension(file, kTension, rows_of(elements, 1, 8, options, "N")),
        strain(file, kStrain, rows_of(elements, 1, 8, options, "1")),
        active(file, kActive, rows_of(elements, 1, 1, options, "1")) {}
  void append(const Frame& frame) {
    position.append(flat(frame.position));
    velocity.append(flat(frame.velocity));
    contact_force.append(flat(frame.contact_force));
    tension.append(frame.tension);
    strain.append(frame.strain);
    active.append(frame.active);
  }
  void hand_over() { h5::hand_over(position, velocity, contact_force, tension, strain, active); }
  Reals position, velocity, contact_force, tension, strain;
  Bytes active;
};

/// Rings, frame by frame: [frames, rings, 3].
struct RingSeries {
  RingSeries(h5::File& file, std::size_t rings, const Recorder::Options& options)
      : center(file, kRingCenter, slabs({rings, 3}, 8, options, "m")),
        normal(file, kRingNormal, slabs({rings, 3}, 8, options, "1")),
        force(file, kRingForce, slabs({rings, 3}, 8, options, "N")) {}
  void append(const Frame& frame) {
    center.append(flat(frame.ring_center));
    normal.append(flat(frame.ring_normal));
    force.append(flat(frame.ring_force));
  }
  void hand_over() { h5::hand_over(center, normal, force); }
  Reals center, normal, force;
};

/// Sliding joints, frame by frame, and the ways of their threads, which follow from them: for viewers.
struct JointSeries {
  JointSeries(h5::File& file, Ways lines, std::size_t joints, const Recorder::Options& options)
      : ways(std::move(lines)),
        element(file, kJointElement, slabs({joints}, 4, options, "")),
        waypoint(file, kJointWaypoint, slabs({joints, 3}, 8, options, "m")),
        points(file, kWayPoints, rows_of(ways.points(), 3, 8, options, "m")),
        tension(file, kWayTension, rows_of(ways.segments(), 1, 8, options, "N")),
        active(file, kWayActive, rows_of(ways.segments(), 1, 1, options, "1")) {
    const auto connectivity = ways.connectivity();
    file.write<std::int64_t>(kWayConnectivity, connectivity, {connectivity.size()});
  }
  void append(const Frame& frame) {
    element.append(frame.joint_element);
    waypoint.append(flat(frame.joint_waypoint));
    const Ways::Trace trace = ways.trace(frame);
    points.append(flat(trace.points));
    tension.append(trace.tension);
    active.append(trace.active);
  }
  void hand_over() { h5::hand_over(element, waypoint, points, tension, active); }
  Ways ways;
  h5::Series<std::int32_t> element;
  Reals waypoint, points, tension;
  Bytes active;
};

void remove_file(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error) throw FileError(file.string() + ": cannot remove it: " + error.message());
}

// It tells of what was there before. Any other file of that name is not ours.
void remove_old_report(const std::filesystem::path& directory) {
  if (is_report_page(directory / kReportFile)) remove_file(directory / kReportFile);
}

// All but its result.
void remove_beside_result(const std::filesystem::path& directory) {
  for (const char* name :
       {kNetXdmfFile, kRingsXdmfFile, kBallsXdmfFile, kWaysXdmfFile, kSummaryFile, kCheckpointFile})
    remove_file(directory / name);
  remove_old_report(directory);
}

void remove_old_run(const std::filesystem::path& directory) {
  remove_file(directory / kResultFile);
  remove_beside_result(directory);
}

std::filesystem::path draft_in(const std::filesystem::path& directory) {
  return directory / (std::string(kResultFile) + ".tmp");
}

// By its folder, as its checkpoint lies there: the file itself may have names elsewhere.
bool lies_in(const Result& result, const std::filesystem::path& directory) {
  const std::filesystem::path folder = result.path().parent_path();
  std::error_code ignored;
  return std::filesystem::equivalent(folder.empty() ? "." : folder, directory, ignored);
}

/// `draft`: beside the place of the result, which stays for the time being.
h5::File create_file(const std::filesystem::path& directory, bool draft) {
  make_folder(directory);
  if (draft) return h5::File::create(draft_in(directory));
  remove_old_run(directory);
  return h5::File::create(directory / kResultFile);
}

void require_sizes(const Frame& frame, NetSize net, const ResultModel& model) {
  const std::size_t rings = model.rings.size(), joints = model.joints.size();
  const bool fits = frame.position.size() == net.nodes && frame.velocity.size() == net.nodes &&
                    frame.contact_force.size() == net.nodes && frame.tension.size() == net.elements &&
                    frame.strain.size() == net.elements && frame.active.size() == net.elements &&
                    frame.ring_center.size() == rings && frame.ring_normal.size() == rings &&
                    frame.ring_force.size() == rings && frame.joint_element.size() == joints &&
                    frame.joint_waypoint.size() == joints;
  if (!fits) throw Error(ExitCode::internal, "recorder: a frame does not have the model's sizes");
}

void require_enough(const Recorder::Earlier& earlier, const ResultModel& model) {
  const std::size_t joints = earlier.result.model().joints.size();
  if (joints != model.joints.size())
    throw FileError("error: " + earlier.result.path().string() + ": holds " + std::to_string(joints) +
                    " sliding joints, the case has " + std::to_string(model.joints.size()) +
                    ": an earlier version did not write them");
  const std::size_t frames = static_cast<std::size_t>(earlier.result.frames()),
                    rows = earlier.result.probe_times().size();
  if (frames >= static_cast<std::size_t>(earlier.frames) && rows >= earlier.probe_rows) return;
  throw FileError("error: " + earlier.result.path().string() + ": holds " + std::to_string(frames) +
                  " frames and " + std::to_string(rows) + " rows of probes; the checkpoint needs " +
                  std::to_string(earlier.frames) + " and " + std::to_string(earlier.probe_rows));
}

}  // namespace

struct Recorder::Impl {
  std::filesystem::path directory;
  ResultModel model;  // without its arrays of nodes and elements once they are written
  NetSize size;
  h5::File file;
  StepTable steps;
  h5::Counter frame_count;
  NetSeries net;
  Integers step_numbers;
  std::vector<Reals> energy;
  std::optional<RingSeries> rings;
  std::optional<JointSeries> joints;
  std::optional<Reals> probe_times, probe_values;
  std::optional<h5::Counter> probe_rows;
  std::vector<double> times;  // s, of all frames
  std::chrono::duration<double> patience;
  Clock::time_point last_hand_over, last_xdmf;
  bool waits = false, finished = false;

  Impl(const std::filesystem::path& folder, ResultModel description, const Options& options, bool draft);
  void write_description(const std::string& run_id);
  void copy(const Earlier& earlier);
  void take_place(const Earlier& earlier);
  void append(const Frame& frame);
  void append_probes(std::span<const double> at, std::span<const double> rows);
  std::size_t waiting_bytes() const;
  bool may_wait(Clock::time_point now) const;
  void write_rows();
  void hand_over();
  void sync();
  void write_events(const std::vector<Event>& events);
};

Recorder::Impl::Impl(const std::filesystem::path& folder, ResultModel description, const Options& options,
                     bool draft)
    : directory(folder),
      model(std::move(description)),
      size{model.node_mass.size(), model.elements.size(), 0, 0},
      file(create_file(folder, draft)),
      steps(file, options.frames),
      frame_count(file, kSteps, kFrameCount),
      net(file, size.nodes, size.elements, options),
      step_numbers(file, kStepNumbers, numbers(options.frames)),
      patience(options.patience) {
  if (!model.joints.empty()) {
    joints.emplace(file, Ways(model), model.joints.size(), options);
    size.way_points = joints->ways.points(), size.way_segments = joints->ways.segments();
  }
  write_description(options.run_id);
  for (const std::string& term : Energies::names())
    energy.emplace_back(file, kEnergy + term, numbers(options.frames, "J"));
  if (!model.rings.empty()) rings.emplace(file, model.rings.size(), options);
  if (!model.probes.empty()) {
    probe_times.emplace(file, kProbeTimes, numbers(options.probe_rows, "s"));
    probe_values.emplace(file, kProbeValues, numbers(options.probe_rows, "", {model.probes.size()}));
    probe_rows.emplace(file, kProbes, kRowCount);
  }
  file.flush();
}

// What only the file needs is freed: a run steps with it for hours.
void Recorder::Impl::write_description(const std::string& run_id) {
  write_model(file, model);
  if (!run_id.empty()) file.set_attribute(kCinch, kRunId, run_id);
  const auto free = [](auto& list) { list = std::decay_t<decltype(list)>(); };
  free(model.elements), free(model.rest_length), free(model.element_radius);
  free(model.element_part), free(model.node_mass);
}

void Recorder::Impl::append(const Frame& frame) {
  require_sizes(frame, size, model);
  const auto k = static_cast<std::int64_t>(times.size());
  steps.append(frame.time, k * static_cast<std::int64_t>(size.nodes),
               k * static_cast<std::int64_t>(size.elements));
  net.append(frame);
  step_numbers.append(frame.step);
  const auto energies = frame.energy.values();
  for (std::size_t i = 0; i < energies.size(); ++i) energy[i].append(energies[i]);
  if (rings) rings->append(frame);
  if (joints) joints->append(frame);
  times.push_back(frame.time);
  waits = true;
}

void Recorder::Impl::append_probes(std::span<const double> at, std::span<const double> rows) {
  probe_times->append(at);
  probe_values->append(rows);
  waits = true;
}

void Recorder::Impl::copy(const Earlier& earlier) {
  for (int k = 0; k < earlier.frames; ++k) {
    append(earlier.result.frame(k));
    if (waiting_bytes() >= kMostWaiting) write_rows();
  }
  if (earlier.probe_rows > 0) {
    const std::vector<double> all = earlier.result.probe_times();
    append_probes(std::span(all).first(earlier.probe_rows), earlier.result.probe_rows(earlier.probe_rows));
  }
  sync();
}

// The draft holds what the old file held up to there, on the disk: a checkpoint beside it counts on that.
// That of another run goes.
void Recorder::Impl::take_place(const Earlier& earlier) {
  const std::filesystem::path draft = file.path(), place = directory / kResultFile;
  std::error_code error;
  if (lies_in(earlier.result, directory)) {
    std::filesystem::remove(directory / kSummaryFile, error);
    remove_old_report(directory);
  } else {
    remove_beside_result(directory);
  }
  std::filesystem::rename(draft, place, error);
  if (error) throw FileError(place.string() + ": cannot replace it: " + error.message());
  file.set_path(place);
}

// Of the largest data sets.
std::size_t Recorder::Impl::waiting_bytes() const {
  return std::max(net.position.waiting_bytes(), probe_values ? probe_values->waiting_bytes() : 0);
}

// The first frame may not: who looks on wants to see something.
bool Recorder::Impl::may_wait(Clock::time_point now) const {
  return last_hand_over != Clock::time_point() && now - last_hand_over < patience &&
         waiting_bytes() < kMostWaiting;
}

void Recorder::Impl::write_rows() {
  h5::hand_over(steps, net, step_numbers);
  for (Reals& term : energy) term.hand_over();
  if (rings) rings->hand_over();
  if (joints) joints->hand_over();
  if (probe_rows) h5::hand_over(*probe_times, *probe_values);
}

// The counters rise only after everything they announce has been handed to the disk.
void Recorder::Impl::hand_over() {
  write_rows();
  file.flush();
  frame_count.set(static_cast<std::int64_t>(times.size()));
  if (probe_rows) probe_rows->set(static_cast<std::int64_t>(probe_times->rows()));
  file.flush();
  waits = false;
  last_hand_over = Clock::now();
}

void Recorder::Impl::sync() {
  hand_over();
  Descriptor(file.path(), O_RDWR).sync();
}

void Recorder::Impl::write_events(const std::vector<Event>& events) {
  std::vector<double> event_times;
  std::vector<std::string> kinds, names;
  for (const Event& event : events) {
    event_times.push_back(event.time);
    kinds.push_back(event.kind);
    names.push_back(event.name);
  }
  const std::string group = kEvents;
  file.write<double>(group + "/time", event_times, {event_times.size()}, "s");
  file.write_texts(group + "/kind", kinds);
  file.write_texts(group + "/name", names);
}

Recorder::Recorder(const std::filesystem::path& directory, ResultModel model, const Options& options)
    : impl_(std::make_unique<Impl>(directory, std::move(model), options, false)) {}

Recorder::Recorder(const std::filesystem::path& directory, ResultModel model, const Options& options,
                   const Earlier& earlier) {
  require_enough(earlier, model);
  try {
    impl_ = std::make_unique<Impl>(directory, std::move(model), options, true);
    impl_->copy(earlier);
    impl_->take_place(earlier);
  } catch (const std::exception&) {  // what it goes on from is still there
    std::error_code ignored;
    std::filesystem::remove(draft_in(directory), ignored);
    throw;
  }
}

Recorder::~Recorder() {
  if (!impl_ || impl_->finished) return;
  try {
    impl_->hand_over();
    write_xdmf(impl_->directory, impl_->model, impl_->size, impl_->times);
  } catch (const std::exception&) {  // what was committed before stays readable
  }
}

void Recorder::frame(const Frame& frame) {
  if (impl_->finished) throw Error(ExitCode::internal, "recorder: a frame after the end");
  impl_->append(frame);
  catch_up();
}

void Recorder::catch_up() {
  Impl& run = *impl_;
  const auto now = Clock::now();
  if (!run.waits || run.may_wait(now)) return;
  run.hand_over();
  if (!run.times.empty() && (run.last_xdmf == Clock::time_point() || now - run.last_xdmf > kXdmfInterval)) {
    write_xdmf(run.directory, run.model, run.size, run.times);
    run.last_xdmf = now;
  }
}

void Recorder::probes(double time, std::span<const double> values) {
  Impl& run = *impl_;
  if (values.size() != run.model.probes.size()) {
    throw Error(ExitCode::internal, "recorder: a probe row does not have the model's columns");
  }
  if (values.empty()) return;
  run.append_probes({&time, 1}, values);
}

void Recorder::sync() { impl_->sync(); }

void Recorder::finish(const Summary& summary) {
  Impl& run = *impl_;
  if (run.finished) throw Error(ExitCode::internal, "recorder: finished twice");
  const std::string json = summary_to_json(summary);
  run.write_events(summary.events);
  run.file.write_text(kSummary, json);
  run.hand_over();
  run.finished = true;
  write_xdmf(run.directory, run.model, run.size, run.times);
  replace_text_file(run.directory / kSummaryFile, json);
}

}  // namespace cinch
