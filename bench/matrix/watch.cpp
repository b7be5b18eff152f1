// A second opinion on energy: summed up here from places, velocities and strains, as the ledger could be
// wrong about the very thing that it watches.
#include "watch.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace cinch::matrix {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct Stored {
  double kinetic = 0, elastic = 0, gravity = 0;
  double size = 0;  ///< sum of sizes: what rounding is relative to
  double sum() const { return kinetic + elastic + gravity; }
};

/// Central differences keep the kinetic energy of the velocities half a step before and after, v-.v+: that of
/// their mean less a quarter of the gain's. At the start the velocity is given. Contacts hold energy, too:
/// without them the sum is too low at most.
Stored stored(const Look& now) {
  const double trembling = now.step() > 0 ? 0.25 : 0;
  const Model& model = now.model();
  Stored out;
  for (Index i = 0; i < model.nodes; ++i) {
    const double m = model.mass[at(i)];
    out.kinetic += 0.5 * m * (now.velocity(i).squaredNorm() - trembling * now.gain(i).squaredNorm());
    out.gravity -= m * model.gravity.dot(now.position(i));
    out.size += std::abs(m * model.gravity.dot(now.position(i)));
  }
  for (Index e = 0; e < model.elements; ++e) {
    const double stretch = std::max(now.pull(e).strain, 0.0) * model.rest_length[at(e)];
    out.elastic += 0.5 * model.stiffness[at(e)] * stretch * stretch;
  }
  out.size += out.kinetic + out.elastic;
  return out;
}

class Books {
 public:
  explicit Books(Simulation& sim) : sim_(&sim), limit_(0.05) {
    const Look& now = sim.look();
    start_ = stored(now);
    contact_ = now.energy().contact;
  }

  /// What is wrong now, or nothing.
  std::string fault(const Look& now) {
    const Stored here = stored(now);
    if (!std::isfinite(here.sum()))
      return "not a number at t = " + words(now.time()) + " s, without an error";
    const Energies ledger = sim_->frame(now).energy;
    fall_ = std::max(fall_, std::abs(here.gravity - start_.gravity));
    const double held = start_.kinetic + start_.elastic + contact_,
                 work = std::max(ledger.work_separation, 0.0);
    const double scale = std::max({held, work, fall_});
    const double won = here.sum() - start_.sum() - contact_ - work;
    if (won > 1.2 * limit_ * scale + rounding(here))
      return "energy grew by " + words(won) + " J, " + words(won / scale) +
             " of what the scene holds, at t = " + words(now.time()) + " s, without an error";
    const double dissipated = std::min(ledger.dissipated_damper, ledger.dissipated_contact);
    if (dissipated < -1.2 * limit_ * scale * takers(now) - rounding(here))
      return "dissipation of " + words(dissipated) + " J at t = " + words(now.time()) + " s";
    return "";
  }

 private:
  /// What takes energy by itself, and is told of by itself.
  static double takers(const Look& now) {
    return static_cast<double>(1 + now.assembly().rings.size() + now.assembly().balls.size());
  }
  static double rounding(const Stored& here) { return 1e-12 * here.size + 1e-20; }  // J

  Simulation* sim_;
  double limit_;  ///< time.residual_limit's default
  Stored start_;
  double contact_ = 0, fall_ = 0;
};

/// Nothing where it is rounding in a scene without energy.
double relative_residual(Simulation& sim) {
  const Summary now = sim.summary();
  return std::abs(now.energy.residual) <= 1e-12 ? 0 : now.relative_residual;
}

void run(Simulation& sim, const Watch& how, Outcome& out) {
  Books books(sim);
  for (int look = 1; look <= how.looks && out.message.empty(); ++look) {
    sim.advance_to(how.steps * look / how.looks);
    out.steps = sim.step();
    out.residual = std::max(out.residual, relative_residual(sim));
    const Look& now = sim.look();
    sim.check_energy(now);
    out.message = books.fault(now);
  }
  out.verdict = out.message.empty() ? Verdict::held : Verdict::failed;
}

bool has(const std::string& text, const char* piece) { return text.find(piece) != std::string::npos; }

}  // namespace

std::string flaw_of_message(const std::string& message) {
  if (!has(message, "at t = ")) return "no time";
  if (!has(message, "node ") && !has(message, "element ") && !has(message, "the mass ")) return "no item";
  if (!has(message, "likely cause: ")) return "no cause";
  return "";
}

Outcome watch(const SceneMaker& make, const Watch& how) {
  Outcome out;
  std::unique_ptr<Simulation> sim;
  try {
    sim = std::make_unique<Simulation>(make(), how.threads);
    run(*sim, how, out);
  } catch (const CaseError& error) {
    out.verdict = Verdict::stopped;
    out.message = error.what();
  } catch (const NumericalError& error) {
    out.message = error.what();
    const std::string flaw =
        sim ? flaw_of_message(out.message) : "";  // no equilibrium found: there is no time
    out.verdict = flaw.empty() ? Verdict::stopped : Verdict::failed;
    if (!flaw.empty()) out.message = flaw + " in the message: " + out.message;
  }
  if (sim) out.steps = sim->step();
  return out;
}

}  // namespace cinch::matrix
