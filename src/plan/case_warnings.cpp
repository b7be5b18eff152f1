#include "plan/case_warnings.hpp"

#include <algorithm>
#include <cstdio>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::string warning(const SourceRef& source, const std::string& message) {
  return (source.text.empty() ? std::string() : source.text + ": ") + "warning: " + message;
}

std::string words(const char* format, double a, double b = 0) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

std::string words_of_miss(const Assembly& assembly, const AssemblyRing& ring, const std::string& name) {
  const Miss& miss = *ring.missed;
  if (miss.thickness > 0)
    return assembly.parts[at(miss.part)].reference() +
           words(" (diameter %.6g m) does not fit the opening (%.6g m) of ", miss.thickness,
                 2 * (ring.radius - ring.wire_radius)) +
           name;
  return "no thread passes through " + name +
         (miss.part < 0 ? std::string(": none crosses its plane")
                        : ": the nearest, " + assembly.parts[at(miss.part)].reference() +
                              words(", lies %.3g m outside of its opening", miss.distance));
}

// Rings of one row miss alike: one warning for all of a place in the file.
void warn_of_missed_rings(const Scene& scene, const Assembly& assembly, std::vector<std::string>& warnings) {
  std::vector<std::string> told;
  for (std::size_t r = 0; r < assembly.rings.size(); ++r) {
    const AssemblyRing& ring = assembly.rings[r];
    const SourceRef& source = scene.rings[r].source;
    if (!ring.missed || std::find(told.begin(), told.end(), source.text) != told.end()) continue;
    if (!source.text.empty()) told.push_back(source.text);
    const auto alike = std::count_if(scene.rings.begin(), scene.rings.end(), [&](const Ring& other) {
      return !source.text.empty() && other.source.text == source.text &&
             assembly.rings[static_cast<std::size_t>(&other - scene.rings.data())].missed;
    });
    const std::string name = "ring '" + ring.name + "'" +
                             (alike > 1 ? " (and " + std::to_string(alike - 1) + " more of this row)" : "");
    warnings.push_back(warning(
        source,
        words_of_miss(assembly, ring, name) +
            "; its joint = \"auto\" becomes contact with the wire (joint = \"contact\" says so without this "
            "warning)"));
  }
}

std::string path_of(const Thread& thread) {
  std::string path;
  for (const std::string& part : thread.along) path += (path.empty() ? "" : ", ") + part;
  return path;
}

const Thread& thread_of(const Scene& scene, const std::string& name) {
  return *std::find_if(scene.threads.begin(), scene.threads.end(),
                       [&](const Thread& thread) { return thread.name == name; });
}

void warn_of_short_threads(const Scene& scene, const Assembly& assembly, std::vector<std::string>& warnings) {
  for (const LaidThread& laid : assembly.laid) {
    if (laid.strain() <= great_laid_strain) continue;
    const std::string& name = assembly.parts[at(laid.part)].name;
    const Thread& thread = thread_of(scene, name);
    warnings.push_back(warning(
        thread.source, "closing thread '" + name + "'" +
                           words(" of length_m = %.6g m is laid over %.6g m", laid.length, laid.covered) +
                           " (along " + path_of(thread) + ")" +
                           words(": it begins with %.3g %% of strain, allowed without this warning: %.3g %%",
                                 100 * laid.strain(), 100 * great_laid_strain)));
  }
}

const SourceRef& source_of(const Scene& scene, const Part& part) {
  const auto named = [&](const auto& items) -> const SourceRef& {
    return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == part.name; })
        ->source;
  };
  if (part.kind == PartKind::net) return named(scene.nets);
  return part.kind == PartKind::mechanism ? named(scene.mechanisms) : thread_of(scene, part.name).source;
}

// What pulls an element that ends at another part's node.
std::string gap_of(const Scene& scene, const Part& part, const BeginStrain& begin) {
  if (begin.on.empty()) return "";
  const std::string own =
      part.closing ? "it is laid (along " + path_of(thread_of(scene, part.name)) + ")" : "points_m lead";
  return "; " + begin.on + words(", on which it hangs there, lies %.3g m from where ", begin.gap) + own;
}

void warn_of_great_strain(const Scene& scene, const Preparation& preparation,
                          std::vector<std::string>& warnings) {
  for (const BeginStrain& begin : preparation.strained) {
    const Part& part = preparation.assembly.parts[at(begin.part)];
    warnings.push_back(warning(source_of(scene, part),
                               element_label(preparation, begin.element) +
                                   words(" begins with %.4g %% of strain, the most of its part, allowed "
                                         "without this warning: %.3g %%",
                                         100 * begin.strain, 100 * great_laid_strain) +
                                   gap_of(scene, part, begin)));
  }
}

void warn_of_thick_nets(const Scene& scene, std::vector<std::string>& warnings) {
  for (const Net& net : scene.nets) {
    const double side = net.mesh / net.elements_per_side;
    if (net.diameter < side) continue;
    warnings.push_back(
        warning(net.source, "net '" + net.name + "'" +
                                words(" has threads of diameter_m = %.6g m, as thick as their elements are "
                                      "long or thicker: %.6g m (mesh_m / elements_per_side)",
                                      net.diameter, side)));
  }
}

void warn_of_late_closing(const Scene& scene, const Preparation& preparation,
                          std::vector<std::string>& warnings) {
  const bool closes = preparation.closing_step >= 0;
  if (!closes || preparation.closing_step <= preparation.end_step) return;
  warnings.push_back(warning(scene.closing.source,
                             words("closing.time_s = %.6g s comes after time.end_s = %.6g s: nothing closes",
                                   scene.closing.time.value_or(0), scene.time.end)));
}

// Frames, or rows of probes, that a given step cannot keep up with.
void warn_of_long_steps(const Phase& phase, const char* key, double interval, const char* what,
                        std::vector<std::string>& warnings) {
  constexpr double rounding = 1e-9;
  if (!phase.step_given || !(interval > 0) || phase.plan.dt <= interval * (1 + rounding)) return;
  const std::string text =
      warning(phase.step_source, phase.step_key + words(" = %.6g s is longer than ", phase.plan.dt) + key +
                                     words(" = %.6g s: ", interval) + what + " come every step only");
  // both phases may have the step from one key
  if (std::find(warnings.begin(), warnings.end(), text) == warnings.end()) warnings.push_back(text);
}

void warn_of_long_steps(const Scene& scene, const Preparation& preparation,
                        std::vector<std::string>& warnings) {
  for (const Phase& phase : preparation.phases) {
    if (phase.plan.first_step > 0 && phase.plan.first_step >= preparation.end_step) break;  // never comes
    warn_of_long_steps(phase, "output.frame_interval_s", scene.output.frame_interval, "frames", warnings);
    warn_of_long_steps(phase, "output.probe_interval_s", scene.output.probe_interval, "rows of probes",
                       warnings);
  }
}

}  // namespace

std::vector<std::string> case_warnings(const Scene& scene, const Preparation& preparation) {
  std::vector<std::string> warnings;
  warn_of_late_closing(scene, preparation, warnings);
  warn_of_long_steps(scene, preparation, warnings);
  warn_of_short_threads(scene, preparation.assembly, warnings);
  warn_of_great_strain(scene, preparation, warnings);
  warn_of_thick_nets(scene, warnings);
  warn_of_missed_rings(scene, preparation.assembly, warnings);
  return warnings;
}

}  // namespace cinch
