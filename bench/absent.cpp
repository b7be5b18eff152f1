#include "absent.hpp"

#include "base/error.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch {

#define CINCH_DECLARE_STRIPPED(isa)                      \
  namespace isa {                                        \
  void fill_stripped(bench::StrippedPrograms& programs); \
  }
CINCH_DECLARE_STRIPPED(stripped_base)
#ifdef CINCH_X86_ISAS
CINCH_DECLARE_STRIPPED(stripped_v3)
CINCH_DECLARE_STRIPPED(stripped_v4)
#endif

namespace bench {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

StrippedPrograms choose() {
  StrippedPrograms programs{};
  [[maybe_unused]] const std::string isa = kernels().isa;
#ifdef CINCH_X86_ISAS
  if (isa == "v4") return stripped_v4::fill_stripped(programs), programs;
  if (isa == "v3") return stripped_v3::fill_stripped(programs), programs;
#endif
  stripped_base::fill_stripped(programs);
  return programs;
}

}  // namespace

const StrippedPrograms& stripped_programs() {
  static const StrippedPrograms programs = choose();
  return programs;
}

const std::vector<AbsentFeature>& absent_features() {
  static const std::vector<AbsentFeature> features{
      {"gravity", {.gravity = false}},
      {"damping", {.damping = false, .gravity = true}},
      {"rings", {.gravity = true}},
      {"target", {.gravity = true}},
      {"probes", {.gravity = true}},
      {"ledger", {.ledger = false, .gravity = true}},
      {"all", {.damping = false, .ledger = false, .gravity = false}},
  };
  return features;
}

StrippedNet::StrippedNet(const Features& has)
    : start_(net_scene(absent_knots, has), 1),
      model_(start_.model()),
      state_(start_.state()),
      work_(reduce_forces(model_.topology, Numbering::all(model_.nodes), {})) {
  if (!work_.links.empty() || !work_.kicks.empty())
    throw Error(ExitCode::internal, "error: the stripped programs know no links");
  const double dt = start_.stepper().plan().dt;
  palette_ = make_palette(model_, model_.topology, dt);
  for (Index i = 0; i < model_.nodes; ++i) scale_.push_back(dt / model_.mass[at(i)]);
  for (auto& f : force_) f.assign(at(work_.force_count), 0.0);
  damper_.assign(palette_.of_group.size() * kernel::lanes, 0.0);
  for (const Block& b : work_.blocks)
    blocks_.push_back({b.patch_begin, b.patch_end, b.span_begin, b.neighbour_begin, b.span_end,
                       b.stretch_begin, b.chain_stretch_end, b.stretch_end});
  State& s = state_;
  scene_.axial = {s.x.data(),
                  s.y.data(),
                  s.z.data(),
                  s.vx.data(),
                  s.vy.data(),
                  s.vz.data(),
                  palette_.of_group.data(),
                  palette_.rows.data(),
                  force_[0].data(),
                  force_[1].data(),
                  force_[2].data(),
                  s.dissipated.data(),
                  damper_.data(),
                  nullptr,
                  nullptr,
                  dt};
  const Vec3 g = dt * model_.gravity;
  scene_.node = {
      s.x.data(),    s.y.data(),       s.z.data(),       s.vx.data(),      s.vy.data(),           s.vz.data(),
      scale_.data(), force_[0].data(), force_[1].data(), force_[2].data(), {g.x(), g.y(), g.z()}, dt};
  scene_.blocks = blocks_.data(), scene_.block_count = static_cast<Index>(blocks_.size());
  scene_.patches = work_.patches.data(), scene_.spans = work_.spans.data();
  scene_.stretches = work_.stretches.data();
  advance_ = stripped_programs().advance[has.damping][has.ledger][has.gravity];
}

}  // namespace bench
}  // namespace cinch
