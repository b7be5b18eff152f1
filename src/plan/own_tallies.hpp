// What one thread books about its contacts. Where threads share a scene, each has copies of its own: tallies
// that lie side by side in the state would make their cores wait for each other's writes.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace cinch {

template <class Tally>
class OwnTallies {
 public:
  /// `kept`: where the state keeps them, null where another thread books. `copied`: threads share the scene.
  void keep(std::vector<Tally*> kept, bool copied) {
    kept_ = std::move(kept);
    used_ = kept_;
    own_.clear();
    if (!copied) return;
    own_.resize(kept_.size());
    for (std::size_t i = 0; i < kept_.size(); ++i)
      if (kept_[i]) used_[i] = &own_[i];
  }

  /// From and to the state: before and after steps.
  void take() {
    for (std::size_t i = 0; i < own_.size(); ++i)
      if (kept_[i]) own_[i] = *kept_[i];
  }
  void give() const {
    for (std::size_t i = 0; i < own_.size(); ++i)
      if (kept_[i]) *kept_[i] = own_[i];
  }

  Tally* const* data() const { return used_.data(); }  ///< where to book, or null
  std::size_t memory() const {
    return (kept_.capacity() + used_.capacity()) * sizeof(Tally*) + own_.capacity() * sizeof(Tally);
  }

 private:
  std::vector<Tally*> kept_, used_;
  std::vector<Tally> own_;
};

}  // namespace cinch
