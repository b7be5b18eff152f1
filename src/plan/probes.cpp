#include "plan/probes.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "scene/mouth.hpp"

namespace cinch {
namespace {

const char* quantity_name(ProbeQuantity q) {
  static constexpr const char* names[] = {
      "position", "displacement",        "velocity",   "speed",        "force",
      "tension",  "material_coordinate", "mouth_area", "mouth_spread", "energy"};
  return names[static_cast<std::size_t>(q)];
}

const char* quantity_unit(ProbeQuantity q) {
  static constexpr const char* units[] = {"m", "m", "m/s", "m/s", "N", "N", "m", "m^2", "m", "J"};
  return units[static_cast<std::size_t>(q)];
}

std::vector<std::string> suffixes(ProbeQuantity q) {
  switch (q) {
    case ProbeQuantity::position:
    case ProbeQuantity::displacement:
    case ProbeQuantity::velocity:
      return {".x", ".y", ".z"};
    case ProbeQuantity::force:
      return {".x", ".y", ".z", ".magnitude"};
    case ProbeQuantity::energy: {
      std::vector<std::string> terms;
      for (const std::string& name : Energies::names()) terms.push_back("." + name);
      return terms;
    }
    default:
      return {""};
  }
}

// A ring or a node, whatever the probe is of.
struct Subject {
  bool ring = false;
  Index index = 0;
};

Subject subject_of(const Assembly& assembly, const Probe& probe) {
  if (probe.of.starts_with("ring.")) return {true, assembly.ring_of(probe.of)};
  return {false, assembly.node_of(probe.of)};
}

// The node that moves with the subject (a ring on an element has none: probe_columns refuses its velocity).
Index node_of(const Assembly& assembly, const Subject& subject) {
  return subject.ring ? assembly.rings[static_cast<std::size_t>(subject.index)].node : subject.index;
}

// The part that a probe is of ("thread.NAME", "net.NAME", "mechanism.NAME"), or null.
const Part* part_of(const Assembly& assembly, const Probe& probe) {
  for (const Part& part : assembly.parts)
    if (probe.of == part.reference() && part.elements > 0) return &part;
  return nullptr;
}

// Calls visit(joint's state) for those of a ring.
template <class Visit>
void each_joint_of(const Look& now, Index ring, Visit visit) {
  const std::vector<kernel::Joint>& joints = now.model().joints;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].ring == ring) visit(now.joints()[j]);
}

// Greatest tension of the threads that slide through a ring.
double ring_tension(const Look& now, Index ring) {
  double greatest = 0;
  each_joint_of(now, ring,
                [&](const kernel::JointState& joint) { greatest = std::max(greatest, joint.tension); });
  return greatest;
}

// Unstretched thread from its start to the one joint of a ring; where the ring lies on it as long as the
// thread waits for the closing time.
double material_coordinate(const Look& now, Index ring) {
  double along = now.assembly().rings[static_cast<std::size_t>(ring)].threadings.front().coordinate;
  each_joint_of(now, ring, [&](const kernel::JointState& joint) { along = joint.along; });
  return along;
}

// Greatest tension of the elements of a part, or of those that meet at a node.
double greatest_tension(const Look& now, const Probe& probe) {
  double greatest = 0;
  if (probe.of.starts_with("ring.")) return ring_tension(now, now.assembly().ring_of(probe.of));
  if (const Part* part = part_of(now.assembly(), probe)) {
    for (Index e = 0; e < part->elements; ++e)
      greatest = std::max(greatest, now.pull(part->first_element + e).tension);
    return greatest;
  }
  const Index node = now.assembly().node_of(probe.of);
  for (std::size_t e = 0; e < now.model().end_a.size(); ++e)
    if (now.model().end_a[e] == node || now.model().end_b[e] == node)
      greatest = std::max(greatest, now.pull(static_cast<Index>(e)).tension);
  return greatest;
}

void append(std::vector<double>& row, const Vec3& v) { row.insert(row.end(), {v.x(), v.y(), v.z()}); }

void append_value(std::vector<double>& row, const Probe& probe, const Look& now, const Energies& energy,
                  const std::vector<Vec3>& nodes_at_start, const std::vector<Vec3>& rings_at_start) {
  const Assembly& assembly = now.assembly();
  switch (probe.quantity) {
    case ProbeQuantity::mouth_area:
      row.push_back(now.mouth_area());
      return;
    case ProbeQuantity::mouth_spread:
      row.push_back(mouth_spread(now.ring_centers()));
      return;
    case ProbeQuantity::energy: {
      const std::vector<double> terms = energy.values();
      row.insert(row.end(), terms.begin(), terms.end());
      return;
    }
    case ProbeQuantity::tension:
      row.push_back(greatest_tension(now, probe));
      return;
    case ProbeQuantity::material_coordinate:
      row.push_back(material_coordinate(now, assembly.ring_of(probe.of)));
      return;
    default:
      break;
  }
  const Subject subject = subject_of(assembly, probe);
  const Index i = subject.index;
  const auto place = [&] { return subject.ring ? now.ring_center(i) : now.position(i); };
  switch (probe.quantity) {
    case ProbeQuantity::position:
      append(row, place());
      break;
    case ProbeQuantity::displacement:
      append(row, place() - (subject.ring ? rings_at_start : nodes_at_start)[static_cast<std::size_t>(i)]);
      break;
    case ProbeQuantity::velocity:
      append(row, now.velocity(node_of(assembly, subject)));
      break;
    case ProbeQuantity::speed:
      row.push_back(now.velocity(node_of(assembly, subject)).norm());
      break;
    default: {  // force
      const Vec3 force = subject.ring ? now.ring_force(i) : now.contact_force(i);
      append(row, force);
      row.push_back(force.norm());
    }
  }
}

[[noreturn]] void refuse(const Probe& probe, const std::string& why) {
  throw CaseError(probe.source.text + ": error: probe '" + probe.name + "': " + why);
}

// Rings with contact have neither tension nor a place on a thread.
void check_joints(const Assembly& assembly, const Probe& probe) {
  const std::size_t threads =
      assembly.rings[static_cast<std::size_t>(assembly.ring_of(probe.of))].threadings.size();
  if (threads == 1 || (threads > 1 && probe.quantity == ProbeQuantity::tension)) return;
  refuse(probe, std::to_string(threads) + " threads slide through '" + probe.of + "'; allowed: a ring with " +
                    (probe.quantity == ProbeQuantity::tension ? "sliding joints" : "one sliding joint"));
}

void check_motion(const Assembly& assembly, const Probe& probe) {
  const Subject subject = subject_of(assembly, probe);
  if (subject.ring && node_of(assembly, subject) < 0)
    refuse(probe, "a ring on an element has no velocity of its own");
}

// What the reader cannot know: whether there is such a thing, and whether it has the quantity.
void check_subject(const Assembly& assembly, const Probe& probe) {
  switch (probe.quantity) {
    case ProbeQuantity::mouth_area:
    case ProbeQuantity::mouth_spread:
    case ProbeQuantity::energy:
      return;
    case ProbeQuantity::velocity:
    case ProbeQuantity::speed:
      return check_motion(assembly, probe);
    case ProbeQuantity::material_coordinate:
      return check_joints(assembly, probe);
    case ProbeQuantity::tension:
      if (probe.of.starts_with("ring.")) return check_joints(assembly, probe);
      if (part_of(assembly, probe) == nullptr) assembly.node_of(probe.of);  // throws where there is none
      return;
    default:
      subject_of(assembly, probe);
  }
}

}  // namespace

std::vector<ResultModel::ProbeColumn> probe_columns(const Scene& scene, const Assembly& assembly) {
  std::vector<ResultModel::ProbeColumn> columns;
  for (const Probe& probe : scene.probes) {
    const ProbeQuantity q = probe.quantity;
    check_subject(assembly, probe);
    for (const std::string& suffix : suffixes(q))
      columns.push_back({probe.name + suffix, quantity_name(q), probe.of, quantity_unit(q)});
  }
  return columns;
}

bool needs_node_start(const Scene& scene) {
  return std::any_of(scene.probes.begin(), scene.probes.end(), [](const Probe& probe) {
    return probe.quantity == ProbeQuantity::displacement && !probe.of.starts_with("ring.");
  });
}

std::vector<double> probe_values(const Scene& scene, const Look& now, const Energies& energy,
                                 const std::vector<Vec3>& nodes_at_start,
                                 const std::vector<Vec3>& rings_at_start) {
  std::vector<double> row;
  for (const Probe& probe : scene.probes)
    append_value(row, probe, now, energy, nodes_at_start, rings_at_start);
  return row;
}

}  // namespace cinch
