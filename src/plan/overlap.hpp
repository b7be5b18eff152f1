// Contacts that overlap where they begin, before anything has moved: at t = 0, or when closing threads are
// laid. They make what follows go wrong, so that faults of the first looks are told as theirs.
#pragma once
#include <optional>
#include <string>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "base/result.hpp"
#include "plan/contact_list.hpp"
#include "plan/preparation.hpp"

namespace cinch {

/// The deepest of those that begin together.
struct Overlap {
  kernel::Pair pair{};
  bool ring = false;      ///< with a ring; else with a target
  double depth = 0;       ///< m
  std::int64_t step = 0;  ///< where they begin
  double share = 0;       ///< of the energy that the scene then holds, gravity's apart: what they all hold
};

/// Among the pairs of elements from `first` on (masses, too, where it is 0).
std::optional<Overlap> find_overlap(const Model& model, const State& state, const ContactList& contacts,
                                    Index first);

class OverlapWatch {
 public:
  /// Looks at the contacts that begin now, those of elements from `first` on. They hold `energy` (J) of what
  /// the scene has, `now`.
  void begin(const Model& model, const State& state, const ContactList& contacts, Index first, double energy,
             const Energies& now);
  /// A look at energies has found nothing wrong.
  void note_sound(std::int64_t step) { sound_looks_ += step > (overlap_ ? overlap_->step : 0); }

  /// Runs `check`; a NumericalError of it is told as the overlap's, where that decides how the motion begins.
  template <class Check>
  void blame(const Preparation& preparation, const State& state, Check check) const {
    try {
      check();
    } catch (const NumericalError& fault) {
      if (to_blame(preparation, state)) report(preparation, fault.what());
      throw;
    }
  }
  /// As the model's state goes on; where an earlier version saved it, nothing is known of overlaps.
  void transfer(Archive& archive, const Model& model);
  /// Of overlaps that hold much of the energy; else empty.
  std::string warning(const Preparation& preparation) const;

 private:
  bool to_blame(const Preparation& preparation, const State& state) const;
  [[noreturn]] void report(const Preparation& preparation, const std::string& what) const;

  std::optional<Overlap> overlap_;
  int sound_looks_ = 0;  ///< since it began
};

}  // namespace cinch
