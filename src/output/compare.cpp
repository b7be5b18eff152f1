#include "output/compare.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <map>
#include <ostream>
#include <utility>

#include "output/model_io.hpp"

namespace cinch {
namespace {

using std::size_t;
using std::string;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Which entries of two ascending lists of times are of one and the same time: those nearest to each other, no
// farther apart than `slack`, s (samples are taken at the step nearest to their time).
struct Partners {
  std::vector<std::pair<int, int>> pairs;
  size_t alone_a, alone_b;

  Partners(const std::vector<double>& a, const std::vector<double>& b, double slack) {
    size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
      const double apart = std::abs(a[i] - b[j]);
      if (i + 1 < a.size() && std::abs(a[i + 1] - b[j]) < apart) ++i;
      else if (j + 1 < b.size() && std::abs(a[i] - b[j + 1]) < apart) ++j;
      else if (apart <= slack) pairs.emplace_back(static_cast<int>(i++), static_cast<int>(j++));
      else if (a[i] < b[j]) ++i;
      else ++j;
    }
    alone_a = a.size() - pairs.size();
    alone_b = b.size() - pairs.size();
  }
};

// Which entries of two lists have the same name.
template <class Item>
std::vector<std::pair<size_t, size_t>> same_names(const std::vector<Item>& a, const std::vector<Item>& b) {
  std::map<string, size_t> places;
  for (size_t j = 0; j < b.size(); ++j) places.emplace(b[j].name, j);
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t i = 0; i < a.size(); ++i)
    if (const auto found = places.find(a[i].name); found != places.end())
      pairs.emplace_back(i, found->second);
  return pairs;
}

/// Follows one field through both runs.
struct Meter {
  FieldDifference difference;
  double largest = 0;  // magnitude in either run
  size_t seen = 0;

  void pair(double a, double b, int frame, double time, size_t index) {
    ++seen;
    if (std::isfinite(a)) largest = std::max(largest, std::abs(a));
    if (std::isfinite(b)) largest = std::max(largest, std::abs(b));
    if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) return;
    if (difference.values++ == 0) {
      difference.first_frame = frame;
      difference.first_time = time;
      difference.first_index = index;
    }
    const double distance = std::abs(a - b);
    // Two nans of different bits are no distance apart; one nan is beyond every number.
    const double absolute =
        std::isnan(distance) ? (std::isnan(a) && std::isnan(b) ? 0 : kInfinity) : distance;
    difference.absolute = std::max(difference.absolute, absolute);
  }
};

class Comparer {
 public:
  Comparer(const Result& a, const Result& b) : a_(a), b_(b) {}
  Comparison run();

 private:
  void differ(const string& sentence) { out_.shape.push_back(sentence); }
  template <class T>
  bool same(const string& what, const T& a, const T& b);
  void note(const string& what, const string& a, const string& b);
  Meter& meter(const string& field, const string& unit);
  template <class A>
  void list(const string& field, const string& unit, const A& a, const A& b, int frame = -1,
            double time = kNan);
  void vectors(const string& field, const string& unit, const std::vector<Vec3>& a,
               const std::vector<Vec3>& b, int frame = -1, double time = kNan);
  void series(const string& field, const string& unit, const Partners& partners,
              const std::vector<double>& times, const std::vector<double>& a, const std::vector<double>& b);
  void models();
  void meshes();
  void elements();
  void bodies();
  static double longest_step(const ResultModel& m) { return std::max(m.time_step, m.closing_time_step); }
  double slack() const { return 0.5 * (longest_step(a_.model()) + longest_step(b_.model())); }
  void partners_lacking(const string& what, const Partners& partners);
  void frames();
  void frame(int k, int l);
  void mesh_frame(const Frame& a, const Frame& b, int k);
  void ring_frame(const Frame& a, const Frame& b, int k);
  void probes();
  void summaries();
  void events(const Summary& a, const Summary& b);
  void rings(const Summary& a, const Summary& b, bool to_the_end);
  void collect();

  const Result &a_, &b_;
  Comparison out_;
  bool same_mesh_ = true, same_joints_ = true;
  std::vector<std::pair<size_t, size_t>> rings_;  // of the same name
  std::map<string, size_t> index_;
  std::vector<Meter> meters_;  // in the order in which the fields were met
};

string text(size_t value) { return std::to_string(value); }
string text(int value) { return std::to_string(value); }
string text(const string& value) { return value; }

template <class T>
bool Comparer::same(const string& what, const T& a, const T& b) {
  if (a == b) return true;
  differ(what + ": " + text(a) + " in A, " + text(b) + " in B");
  return false;
}

void Comparer::note(const string& what, const string& a, const string& b) {
  if (a != b) out_.notes.push_back(what + ": " + a + " in A, " + b + " in B");
}

Meter& Comparer::meter(const string& field, const string& unit) {
  const auto [place, fresh] = index_.try_emplace(field, meters_.size());
  if (fresh) {
    meters_.emplace_back();
    meters_.back().difference.field = field;
    meters_.back().difference.unit = unit;
  }
  return meters_[place->second];
}

template <class A>
void Comparer::list(const string& field, const string& unit, const A& a, const A& b, int frame, double time) {
  Meter& gauge = meter(field, unit);
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    gauge.pair(static_cast<double>(a[i]), static_cast<double>(b[i]), frame, time, i);
  }
}

void Comparer::vectors(const string& field, const string& unit, const std::vector<Vec3>& a,
                       const std::vector<Vec3>& b, int frame, double time) {
  Meter& gauge = meter(field, unit);
  const auto x = flat(a), y = flat(b);
  for (size_t i = 0; i < std::min(x.size(), y.size()); ++i) gauge.pair(x[i], y[i], frame, time, i / 3);
}

void Comparer::series(const string& field, const string& unit, const Partners& partners,
                      const std::vector<double>& times, const std::vector<double>& a,
                      const std::vector<double>& b) {
  Meter& gauge = meter(field, unit);
  for (const auto& [k, l] : partners.pairs) {
    const auto i = static_cast<size_t>(k), j = static_cast<size_t>(l);
    if (i < a.size() && j < b.size()) gauge.pair(a[i], b[j], k, times[i], 0);
  }
}

template <class Item>
std::vector<string> names_of(const std::vector<Item>& items) {
  std::vector<string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

void Comparer::models() {
  const ResultModel &a = a_.model(), &b = b_.model();
  note("case", a.case_name, b.case_name);
  note("version", a.version + " " + a.commit, b.version + " " + b.commit);
  note("compiler", a.compiler, b.compiler);
  note("instruction set", a.isa, b.isa);
  note("threads", text(a.threads), text(b.threads));
  if (a.case_toml != b.case_toml) out_.notes.push_back("the resolved case texts differ");
  meshes();
  if (a.closing_time.has_value() != b.closing_time.has_value()) differ("only one of them has a closing time");
  list("time steps", "s", std::vector{a.time_step, a.closing_time_step},
       std::vector{b.time_step, b.closing_time_step});
  list("closing time", "s", std::vector{a.closing_time.value_or(0)}, std::vector{b.closing_time.value_or(0)});
  if (same_mesh_) elements();
  bodies();
}

// Numbers of nodes and elements mean the same places in like meshes alone.
void Comparer::meshes() {
  const ResultModel &a = a_.model(), &b = b_.model();
  const bool nodes = same("nodes", a.node_mass.size(), b.node_mass.size());
  const bool elements = same("elements", a.elements.size(), b.elements.size());
  const bool ends = !elements || a.elements == b.elements, parts = names_of(a.parts) == names_of(b.parts);
  if (!ends) differ("the elements join different nodes");
  if (!parts) differ("the parts have different names");
  same_mesh_ = nodes && elements && ends && parts;
  if (!same_mesh_)
    out_.notes.push_back(
        "the meshes differ: fields of nodes and elements cannot be compared; rings and probes of the same "
        "name and "
        "energies are");
}

void Comparer::elements() {
  const ResultModel &a = a_.model(), &b = b_.model();
  list("node mass", "kg", a.node_mass, b.node_mass);
  list("rest length", "m", a.rest_length, b.rest_length);
  list("element radius", "m", a.element_radius, b.element_radius);
  list("element part", "", a.element_part, b.element_part);
}

void Comparer::bodies() {
  const ResultModel &a = a_.model(), &b = b_.model();
  if (same("rings", a.rings.size(), b.rings.size()) && names_of(a.rings) != names_of(b.rings))
    differ("the rings have different names");
  rings_ = same_names(a.rings, b.rings);
  same_joints_ = same("sliding joints", a.joints.size(), b.joints.size());
  for (const auto& [i, j] : rings_) {
    meter("ring radius", "m").pair(a.rings[i].radius, b.rings[j].radius, -1, kNan, i);
    meter("ring wire radius", "m").pair(a.rings[i].wire_radius, b.rings[j].wire_radius, -1, kNan, i);
  }
  if (same("balls", a.balls.size(), b.balls.size()) && names_of(a.balls) != names_of(b.balls))
    differ("the balls have different names");
  for (const auto& [i, j] : same_names(a.balls, b.balls)) {
    meter("ball radius", "m").pair(a.balls[i].radius, b.balls[j].radius, -1, kNan, i);
    vectors("ball center", "m", {a.balls[i].center}, {b.balls[j].center});
  }
}

void Comparer::partners_lacking(const string& what, const Partners& partners) {
  if (partners.alone_a + partners.alone_b > 0)
    differ(what + " without partner of the same time: " + text(partners.alone_a) + " in A, " +
           text(partners.alone_b) + " in B");
}

void Comparer::frames() {
  same("frames", a_.frames(), b_.frames());
  const Partners partners(a_.frame_times(), b_.frame_times(), slack());
  partners_lacking("frames", partners);
  out_.frames_compared = static_cast<int>(partners.pairs.size());
  for (const auto& [k, l] : partners.pairs) frame(k, l);
}

void Comparer::frame(int k, int l) {
  const Frame a = a_.frame(k), b = b_.frame(l);
  list("time", "s", std::vector{a.time}, std::vector{b.time}, k, a.time);
  list("step", "", std::vector{a.step}, std::vector{b.step}, k, a.time);
  if (same_mesh_) mesh_frame(a, b, k);
  ring_frame(a, b, k);
  const auto x = a.energy.values(), y = b.energy.values();
  for (size_t i = 0; i < x.size(); ++i) {
    meter("energy " + Energies::names()[i], "J").pair(x[i], y[i], k, a.time, 0);
  }
}

void Comparer::mesh_frame(const Frame& a, const Frame& b, int k) {
  const double t = a.time;
  vectors("position", "m", a.position, b.position, k, t);
  vectors("velocity", "m/s", a.velocity, b.velocity, k, t);
  vectors("contact force", "N", a.contact_force, b.contact_force, k, t);
  list("tension", "N", a.tension, b.tension, k, t);
  list("strain", "", a.strain, b.strain, k, t);
  list("active", "", a.active, b.active, k, t);
  if (!same_joints_) return;
  list("joint element", "", a.joint_element, b.joint_element, k, t);
  vectors("joint waypoint", "m", a.joint_waypoint, b.joint_waypoint, k, t);
}

void Comparer::ring_frame(const Frame& a, const Frame& b, int k) {
  const auto vector = [&](const char* field, const char* unit, const Vec3& x, const Vec3& y, size_t ring) {
    Meter& gauge = meter(field, unit);
    for (int d = 0; d < 3; ++d) gauge.pair(x[d], y[d], k, a.time, ring);
  };
  for (const auto& [i, j] : rings_) {
    vector("ring center", "m", a.ring_center[i], b.ring_center[j], i);
    vector("ring normal", "", a.ring_normal[i], b.ring_normal[j], i);
    vector("ring force", "N", a.ring_force[i], b.ring_force[j], i);
  }
}

void Comparer::probes() {
  const auto a = names_of(a_.model().probes), b = names_of(b_.model().probes);
  if (a != b) differ("the probe columns differ (" + text(a.size()) + " in A, " + text(b.size()) + " in B)");
  const auto times = a_.probe_times(), others = b_.probe_times();
  same("probe rows", times.size(), others.size());
  const Partners partners(times, others, slack());
  partners_lacking("probe rows", partners);
  series("probe time", "s", partners, times, times, others);
  for (const auto& probe : a_.model().probes) {
    if (!b_.has_probe(probe.name)) continue;
    series("probe " + probe.name, probe.unit, partners, times, a_.probe(probe.name), b_.probe(probe.name));
  }
}

void Comparer::events(const Summary& a, const Summary& b) {
  same("events", a.events.size(), b.events.size());
  for (size_t i = 0; i < std::min(a.events.size(), b.events.size()); ++i) {
    const Event &x = a.events[i], &y = b.events[i];
    if (x.kind != y.kind || x.name != y.name) {
      differ("event " + text(i) + ": " + x.kind + " " + x.name + " in A, " + y.kind + " " + y.name + " in B");
      return;  // what follows is shifted
    }
    meter("event time", "s").pair(x.time, y.time, -1, kNan, i);
  }
}

// Peaks are those of whole runs.
void Comparer::rings(const Summary& a, const Summary& b, bool to_the_end) {
  same("ring records", a.ring_records.size(), b.ring_records.size());
  for (const auto& [i, j] : same_names(a.ring_records, b.ring_records)) {
    const RingRecord &x = a.ring_records[i], &y = b.ring_records[j];
    meter("ring first contact time", "s").pair(x.first_contact_time, y.first_contact_time, -1, kNan, i);
    meter("ring first contact force", "N").pair(x.first_contact_force, y.first_contact_force, -1, kNan, i);
    if (!to_the_end) continue;
    meter("ring peak force", "N").pair(x.peak_force, y.peak_force, -1, kNan, i);
    meter("ring peak time", "s").pair(x.peak_time, y.peak_time, -1, kNan, i);
  }
}

void Comparer::summaries() {
  const auto &a = a_.summary(), &b = b_.summary();
  if (a) out_.hash_a = a->state_hash;
  if (b) out_.hash_b = b->state_hash;
  if (a.has_value() != b.has_value()) differ(string("only ") + (a ? "A" : "B") + " has run to its end");
  if (!a || !b) return;
  same("status", a->status, b->status);
  list("steps", "", std::vector{a->steps}, std::vector{b->steps});
  list("simulated time", "s", std::vector{a->simulated_seconds}, std::vector{b->simulated_seconds});
  const bool to_the_end = std::abs(a->simulated_seconds - b->simulated_seconds) <= slack();
  if (to_the_end) {
    list("final energy", "J", a->energy.values(), b->energy.values());
    list("largest penetration", "m", std::vector{a->max_penetration}, std::vector{b->max_penetration});
  } else {
    out_.notes.push_back(
        "they end at different times: final energies, peaks and penetration are not compared");
  }
  events(*a, *b);
  rings(*a, *b, to_the_end);
}

void Comparer::collect() {
  for (Meter& gauge : meters_) {
    out_.values_compared += gauge.seen;
    if (gauge.difference.values == 0) continue;
    const double absolute = gauge.difference.absolute;
    gauge.difference.relative = absolute == 0 ? 0 : absolute / gauge.largest;
    out_.fields.push_back(gauge.difference);
  }
  out_.identical = out_.shape.empty() && out_.fields.empty() && out_.hash_a == out_.hash_b;
}

Comparison Comparer::run() {
  models();
  frames();
  probes();
  summaries();
  collect();
  return std::move(out_);
}

string hash_text(const std::optional<std::uint64_t>& hash) {
  if (!hash) return "none (the run did not end)";
  char out[24];
  std::snprintf(out, sizeof out, "0x%016llx", static_cast<unsigned long long>(*hash));
  return out;
}

// Columns as wide as what stands in them.
struct Widths {
  int field = 26, unit = 6;
  explicit Widths(const std::vector<FieldDifference>& fields) {
    for (const FieldDifference& item : fields) {
      field = std::max(field, static_cast<int>(item.field.size()));
      unit = std::max(unit, static_cast<int>(item.unit.size()));
    }
  }
};

template <class... Values>
string formatted(const char* format, Values... values) {
  const int length = std::snprintf(nullptr, 0, format, values...);
  string out(static_cast<size_t>(length) + 1, '\0');
  std::snprintf(out.data(), out.size(), format, values...);
  out.pop_back();
  return out;
}

void print_field(const FieldDifference& field, const Widths& width, std::ostream& out) {
  out << formatted("  %-*s %10zu  %11.3e %-*s %10.2e  ", width.field, field.field.c_str(), field.values,
                   field.absolute, width.unit, field.unit.c_str(), field.relative);
  if (field.first_frame >= 0) {
    const bool row = field.field.rfind("probe ", 0) == 0;
    out << formatted("%s %d (t = %.9g s), ", row ? "row" : "frame", field.first_frame, field.first_time);
  }
  out << "index " << field.first_index << '\n';
}

}  // namespace

Comparison compare_results(const Result& a, const Result& b) { return Comparer(a, b).run(); }

void print_comparison(const Comparison& comparison, std::ostream& out) {
  const Comparison& c = comparison;
  const Widths width(c.fields);
  out << (c.identical ? "identical" : "different") << ": " << c.frames_compared << " frames, "
      << c.values_compared << " values compared bit by bit\n";
  if (c.hash_a == c.hash_b) {
    out << "state hash: " << hash_text(c.hash_a) << '\n';
  } else {
    out << "state hash: " << hash_text(c.hash_a) << " in A, " << hash_text(c.hash_b) << " in B\n";
  }
  for (const string& sentence : c.shape) out << "  " << sentence << '\n';
  if (!c.fields.empty()) {
    out << formatted("  %-*s %10s  %*s %10s  %s\n", width.field, "field", "values", 12 + width.unit,
                     "largest difference", "relative", "first differs");
  }
  for (const FieldDifference& field : c.fields) print_field(field, width, out);
  for (const string& note : c.notes) out << "  note: " << note << '\n';
}

}  // namespace cinch
