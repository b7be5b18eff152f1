// Keys of the sections that describe the run, and of materials, targets and probes.
#include "input/key_table.hpp"

namespace cinch {

namespace {

using enum KeyType;

const char* const ours = "choice of this program";

}  // namespace

const Section<Scene>& case_section() {
  static const Section<Scene> section(
      {.name = "case", .about = "Words about the case."},
      {
          {{.name = "title", .type = text, .fallback = "\"\"", .meaning = "One line that names the case."},
           into(&Scene::title)},
          {{.name = "about",
            .type = text,
            .fallback = "\"\"",
            .meaning = "What the case shows and what to expect."},
           into(&Scene::about)},
          {{.name = "method",
            .type = choice,
            .words = {"contact", "sliding", "paper"},
            .fallback = "\"sliding\"",
            .meaning =
                "How threads go through rings, as a set of defaults for all of the case: `sliding` joints, "
                "`contact` with wires, or the `paper`'s contact with its step. Keys that are given "
                "go first.",
            .source = "the fastest for an error of 1 % (README, bench/study)"}},
      });
  return section;
}

const Section<TimeSpec>& time_section() {
  static const Section<TimeSpec> section(
      {.name = "time", .required = true, .about = "End and step of the simulation."},
      {
          {{.name = "end_s",
            .unit = "s",
            .range = above(0, 1e6),
            .required = true,
            .meaning = "End of the simulated time."},
           into(&TimeSpec::end)},
          {{.name = "end_when",
            .type = choice,
            .words = {"never", "mouth_closed"},
            .fallback = "\"never\"",
            .meaning = "What ends the run before `end_s`: nothing, or that the net's mouth has closed (the "
                       "event `mouth_closed`, looked for at samples of probes).",
            .source = "the paper's runs go on"},
           into(&TimeSpec::end_when)},
          {{.name = "end_delay_s",
            .unit = "s",
            .range = from(0, 1e6),
            .fallback = "0",
            .meaning = "Time for which a run goes on after what `end_when` names.",
            .source = ours},
           into(&TimeSpec::end_delay)},
          {{.name = "step_s",
            .unit = "s",
            .range = above(0, 1),
            .words = {"auto"},
            .fallback = "\"auto\"",
            .by_method = {{"paper", "1e-6"}},
            .meaning =
                "Time step. `auto`: `safety` times the stable step of what moves, before the closing time "
                "and from it on, but no longer than frames and samples of probes are apart.",
            .source = "the paper's step (Sec. 5.3) is 1e-6 s; whether it is stable depends on the scene"},
           [](TimeSpec& time, const Value& value) { time.step = value.is_word ? 0 : value.number; }},
          {{.name = "safety",
            .range = above(0, 1),
            .fallback = "0.4",
            .meaning = "Automatic step over the stable step; at most 0.3 where a material has "
                       "`damping_ratio` < 0.05, at most 0.2 below 0.02, at most 0.1 below 0.005.",
            .source = "threads that turn slack and taut change energy well below the linear bound if little "
                      "damps them"},
           into(&TimeSpec::safety)},
          {{.name = "joint_steps",
            .type = whole,
            .range = from(1, 1000),
            .words = {"auto"},
            .fallback = "\"auto\"",
            .by_method = {{"paper", "1"}},
            .meaning = "Steps for which the forces of sliding joints hold: they are computed for where nodes "
                       "will be in the middle of them. `auto`: as many, up to 8, as would still be stable "
                       "for twice the stiffness at the stable step; fewer for steps below 0.8 of it.",
            .source = "`bench/study`: errors as with 1 in half of the run time"},
           [](TimeSpec& time, const Value& value) { time.joint_steps = value.is_word ? 0 : value.whole; }},
          {{.name = "allow_unstable",
            .type = flag,
            .fallback = "false",
            .meaning = "Accept a given step above the stable step instead of refusing the run.",
            .source = ours},
           into(&TimeSpec::allow_unstable)},
          {{.name = "speed_limit_m_s",
            .unit = "m/s",
            .range = above(0),
            .fallback = "1e5",
            .meaning = "A node faster than this stops the run.",
            .source = "far above any speed of a sound run, far below overflow"},
           into(&TimeSpec::speed_limit)},
          {{.name = "residual_limit",
            .range = above(0),
            .fallback = "0.05",
            .meaning = "An energy residual above this share (see `cinch info`) stops the run, wherever it is "
                       "looked at: at frames and samples of probes. Not with `allow_unstable`.",
            .source = "the cases stay below 0.002 with any method"},
           into(&TimeSpec::residual_limit)},
      });
  return section;
}

const Section<OutputSpec>& output_section() {
  static const Section<OutputSpec> section(
      {.name = "output", .about = "What is written, and how often."},
      {
          {{.name = "frame_interval_s",
            .unit = "s",
            .range = above(0, 1e6),
            .fallback = "0.01",
            .meaning = "Time between two frames (the whole scene). At most 1e6 frames a run.",
            .source = ours},
           into(&OutputSpec::frame_interval)},
          {{.name = "probe_interval_s",
            .unit = "s",
            .range = from(0, 1e6),
            .fallback = "0",
            .meaning =
                "Time between two samples of the probes; 0: with the frames. At most 1e7 samples a run.",
            .source = ours},
           into(&OutputSpec::probe_interval)},
          {{.name = "ledger",
            .type = flag,
            .fallback = "true",
            .meaning = "Keep the energy ledger (dissipation and work, summed every step).",
            .source = "its residual is the first check of a run"},
           into(&OutputSpec::ledger)},
          {{.name = "compress",
            .type = flag,
            .fallback = "false",
            .meaning = "Deflate the frames.",
            .source = "pays only above about 10,000 nodes"},
           into(&OutputSpec::compress)},
          {{.name = "checkpoint",
            .type = flag,
            .fallback = "true",
            .meaning = "Keep `checkpoint.h5`, from which `cinch run --restart` goes on: written when the run "
                       "ends or is stopped, and in between as the next two keys say.",
            .source = ours},
           into(&OutputSpec::checkpoint)},
          {{.name = "checkpoint_interval_s",
            .unit = "s",
            .range = from(0, 1e6),
            .fallback = "0",
            .meaning = "Simulated time between two checkpoints; 0: none for that reason.",
            .source = ours},
           into(&OutputSpec::checkpoint_interval)},
          {{.name = "checkpoint_run_time_s",
            .unit = "s",
            .range = from(0, 1e6),
            .fallback = "60",
            .meaning = "Run time between two checkpoints; 0: none for that reason.",
            .source = "a minute is what a kill may cost"},
           into(&OutputSpec::checkpoint_run_time)},
      });
  return section;
}

const Section<Scene>& gravity_section() {
  static const Section<Scene> section({.name = "gravity",
                                       .optional_feature = true,
                                       .about = "Uniform gravity. Without this section there is none."},
                                      {
                                          {{.name = "acceleration_m_s2",
                                            .type = vector,
                                            .unit = "m/s^2",
                                            .range = from(-1e4, 1e4),
                                            .required = true,
                                            .meaning = "Acceleration of free fall."},
                                           into(&Scene::gravity)},
                                      });
  return section;
}

const Section<Scene>& start_section() {
  static const Section<Scene> section(
      {.name = "start", .about = "The state at t = 0."},
      {
          {{.name = "equilibrium",
            .type = flag,
            .fallback = "false",
            .meaning = "Start from static equilibrium under gravity instead of the shape as given. It knows "
                       "no contact, and no rings that slide on threads which are there from the start.",
            .source = "Sec. 5.2 starts from a net that hangs at rest"},
           into(&Scene::equilibrium)},
      });
  return section;
}

const Section<Closing>& closing_section() {
  static const Section<Closing> section(
      {.name = "closing",
       .optional_feature = true,
       .about = "When the closing mechanisms separate and threads laid `along` other parts come to life. "
                "Needed as "
                "soon as the case has such threads."},
      {
          {{.name = "time_s",
            .unit = "s",
            .range = from(0, 1e6),
            .required = true,
            .meaning =
                "Starting time of closing. Before it the closing threads and rings are extra mass only "
                "(Sec. 5.3)."},
           into(&Closing::time)},
          {{.name = "step_s",
            .unit = "s",
            .range = above(0, 1),
            .words = {"auto"},
            .fallback_note = "that of `[time]`; with `safety` `\"auto\"`",
            .meaning = "Time step from the closing time on. `auto`: `safety` times the stable step of what "
                       "moves then."},
           [](Closing& closing, const Value& value) { closing.step = value.is_word ? 0 : value.number; }},
          {{.name = "safety",
            .range = above(0, 1),
            .fallback_note = "that of `[time]`",
            .meaning =
                "Automatic step over the stable step from the closing time on; limited as that of `[time]` "
                "where little damps a material.",
            .source = "a net that unfolds is jerked taut, one that closes allows longer steps (README)"},
           into(&Closing::safety)},
      });
  return section;
}

const Section<Contact>& contact_section() {
  static const Section<Contact> section(
      {.name = "contact", .about = "The law of contact, eqs. (3)-(12)."},
      {
          {{.name = "alpha_ring_s_m",
            .unit = "s/m",
            .range = from(0, 100),
            .fallback = "0.05",
            .meaning = "alpha of eq. (9), thread against ring.",
            .source = "not in the paper; published range 0.05 to 0.3"},
           into(&Contact::alpha_ring)},
          {{.name = "alpha_target_s_m",
            .unit = "s/m",
            .range = from(0, 100),
            .fallback = "0.05",
            .meaning = "alpha of eq. (9), thread against target.",
            .source = "not in the paper; published range 0.05 to 0.3"},
           into(&Contact::alpha_target)},
          {{.name = "couple",
            .type = choice,
            .words = {"conserving", "paper"},
            .fallback = "\"conserving\"",
            .by_method = {{"paper", "\"paper\""}},
            .meaning = "Couple of the contact force about a ring's centre: handed to the host element, or "
                       "dropped as "
                       "in eq. (12).",
            .source = "eq. (12) loses angular momentum and energy at any step"},
           into(&Contact::couple)},
          {{.name = "distance",
            .type = choice,
            .words = {"exact", "golden"},
            .fallback = "\"exact\"",
            .by_method = {{"paper", "\"golden\""}},
            .meaning = "Closest point of element and ring, eq. (4): exact roots, or golden section search.",
            .source = "golden section is the paper's method; it misses the second minimum of long elements"},
           into(&Contact::distance)},
          {{.name = "shared_node",
            .type = choice,
            .words = {"once", "paper"},
            .fallback = "\"once\"",
            .by_method = {{"paper", "\"paper\""}},
            .meaning = "A contact at a node shared by elements: counted once, beside what an element "
                       "sinks in deeper than its ends, or by each element (0 <= t <= 1, Sec. 4.1).",
            .source = "the paper's rule doubles the force at nodes"},
           into(&Contact::shared_node)},
          {{.name = "leaving",
            .type = choice,
            .words = {"stop", "event"},
            .fallback = "\"stop\"",
            .meaning =
                "What a thread does that leaves a ring through which it passed: it stops the run, or is "
                "noted among the events. Looked for at samples of probes, every 2000 steps or more.",
            .source = "a thread out of its ring closes nothing"},
           into(&Contact::leaving)},
          {{.name = "margin_m",
            .unit = "m",
            .range = from(0, 1e3),
            .fallback = "0",
            .meaning =
                "Margin of the contact search; 0: chosen from the element lengths. Changes run time only.",
            .source = ours},
           into(&Contact::margin)},
      });
  return section;
}

const Section<Material>& material_section() {
  static const Section<Material> section(
      {.name = "material", .named = true, .about = "A material of threads and nets."},
      {
          {{.name = "youngs_modulus_Pa",
            .unit = "Pa",
            .range = above(0, 1e13),
            .required = true,
            .meaning = "Young's modulus."},
           into(&Material::youngs_modulus)},
          {{.name = "poissons_ratio",
            .range = from(-0.99, 0.5),
            .fallback = "0.3",
            .meaning = "Poisson's ratio.",
            .source = "Table 1, thread"},
           into(&Material::poissons_ratio)},
          {{.name = "density_kg_m3",
            .unit = "kg/m^3",
            .range = above(0, 1e5),
            .required = true,
            .meaning = "Density."},
           into(&Material::density)},
          {{.name = "damping_ratio",
            .range = from(0, 10),
            .fallback = "0.106",
            .meaning = "Damping ratio zeta of the rule below.",
            .source = "not in the paper; used by several published net models"},
           into(&Material::damping_ratio)},
          {{.name = "damping_rule",
            .type = choice,
            .words = {"element", "stiffness"},
            .fallback = "\"element\"",
            .meaning = "`element`: c = 2 zeta sqrt(k m_e), m_e the element's mass. `stiffness`: c = (2 zeta "
                       "/ omega_1) "
                       "k.",
            .source = "not in the paper; the stiffness rule can divide the stable step by 10"},
           into(&Material::damping_rule)},
          {{.name = "damping_frequency_rad_s",
            .unit = "rad/s",
            .range = above(0),
            .fallback_note = "none; needed by the `stiffness` rule",
            .meaning = "omega_1 of the `stiffness` rule."},
           into(&Material::damping_frequency)},
      });
  return section;
}

const Section<BallTarget>& target_section() {
  static const Section<BallTarget> section(
      {.name = "target", .named = true, .about = "A body to be caught, fixed in space."},
      {
          {{.name = "shape",
            .type = choice,
            .words = {"ball"},
            .fallback = "\"ball\"",
            .meaning = "Shape.",
            .source = "Sec. 5.3"}},
          {{.name = "center_m",
            .type = vector,
            .unit = "m",
            .range = from(-1e6, 1e6),
            .required = true,
            .meaning = "Centre."},
           into(&BallTarget::center)},
          {{.name = "radius_m", .unit = "m", .range = above(0, 1e4), .required = true, .meaning = "Radius."},
           into(&BallTarget::radius)},
          {{.name = "youngs_modulus_Pa",
            .unit = "Pa",
            .range = above(0, 1e13),
            .required = true,
            .meaning = "Young's modulus."},
           into(&BallTarget::youngs_modulus)},
          {{.name = "poissons_ratio",
            .range = from(-0.99, 0.5),
            .fallback = "0.39",
            .meaning = "Poisson's ratio.",
            .source = "Table 4, target"},
           into(&BallTarget::poissons_ratio)},
          {{.name = "touches",
            .type = names,
            .refers = a_net | a_thread | a_mechanism,
            .fallback = "[]",
            .meaning =
                "Parts that can touch it: `net.NAME`, `thread.NAME`, `mechanism.NAME` (its towing thread); "
                "empty: all of them.",
            .source = "the paper does not say which parts touch the ball"},
           into(&BallTarget::touches)},
      });
  return section;
}

const Section<Probe>& probe_section() {
  static const Section<Probe> section(
      {.name = "probe",
       .named = true,
       .about =
           "A quantity recorded often. `position`, `displacement`, `velocity` and `speed` are of a node or "
           "ring; `force` is the contact force on a ring or node; `tension` of a thread, net or mechanism is "
           "the greatest of its elements, of a node the greatest of the elements that meet there, of a ring "
           "that of threads that slide through it, the same on both sides; `material_coordinate` of a ring "
           "is how much unstretched thread lies between the start of the one that slides through it and the "
           "ring; `mouth_area` (of the convex hull of all ring centres, in the plane that fits them best), "
           "`mouth_spread` (greatest distance between ring centres) and `energy` are of the whole scene."},
      {
          {{.name = "quantity",
            .type = choice,
            .words = {"position", "displacement", "velocity", "speed", "force", "tension",
                      "material_coordinate", "mouth_area", "mouth_spread", "energy"},
            .required = true,
            .meaning = "What is recorded."},
           into(&Probe::quantity)},
          {{.name = "of",
            .type = name,
            .fallback_note = "none; not for `mouth_area`, `mouth_spread`, `energy`",
            .meaning = "Whose."},
           into(&Probe::of)},
      });
  return section;
}

}  // namespace cinch
