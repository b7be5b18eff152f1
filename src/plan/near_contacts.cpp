#include "plan/near_contacts.hpp"

#include <algorithm>
#include <limits>

namespace cinch {
namespace {

constexpr double window_share = 0.03;  ///< of the margin: bench_contact.cpp measures it

}  // namespace

void NearContacts::renew(LocalContacts contacts, double margin) {
  contacts_ = std::move(contacts);
  window_ = window_share * margin;
  near_until_ = -std::numeric_limits<double>::infinity();
  asleep_.assign(contacts_.pairs.size(), -std::numeric_limits<double>::infinity());
  near_.reserve(contacts_.pairs.size());
  gap_.resize(contacts_.pairs.size());
  loads_.resize(2 * (contacts_.pairs.size() + contacts_.rings.size()));
  load_count_ = 0;
}

// All pairs whose sleep ends within the next window of motion.
void NearContacts::wake(double motion) {
  near_.clear();
  near_rings_ = 0;
  for (std::size_t i = 0; i < asleep_.size(); ++i)
    if (asleep_[i] <= motion + window_) {
      near_.push_back(static_cast<Index>(i));
      near_rings_ += static_cast<Index>(i) < contacts_.ball_begin;
    }
  near_until_ = motion + window_;
}

// Those just looked at that cannot touch within the window.
void NearContacts::put_to_sleep(double motion) {
  std::size_t kept = 0;
  near_rings_ = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const Index pair = near_[i];
    asleep_[static_cast<std::size_t>(pair)] = motion + gap_[i];
    if (gap_[i] > window_) continue;
    near_[kept++] = pair;
    near_rings_ += pair < contacts_.ball_begin;
  }
  near_.resize(kept);
}

void NearContacts::evaluate(const NodeView& n, const StepPlan& plan, double time, double booked_dt,
                            double motion) {
  const bool search = !(motion < near_until_);
  if (search) wake(motion);
  kernel::ContactArguments contact{n.x,  n.y,       n.z,    n.vx, n.vy, n.vz, n.share, plan.alpha_ring,
                                   time, booked_dt, plan.dt};
  const kernel::RingArguments rings{contact,
                                    contacts_.rings.data(),
                                    contacts_.ring_tallies.data(),
                                    static_cast<Index>(contacts_.rings.size()),
                                    plan.golden,
                                    plan.couple};
  load_count_ = kernels().ring_contacts(rings, contacts_.pairs.data(), near_.data(), near_rings_, gap_.data(),
                                        loads_.data());
  contact.alpha = plan.alpha_target;
  const kernel::BallArguments balls{contact, contacts_.centers.data(), contacts_.ball_tallies.data()};
  load_count_ += kernels().ball_contacts(balls, contacts_.pairs.data(), near_.data() + near_rings_,
                                         static_cast<Index>(near_.size()) - near_rings_,
                                         gap_.data() + near_rings_, loads_.data() + load_count_);
  evaluated_ += static_cast<std::int64_t>(near_.size());
  if (search) put_to_sleep(motion);
}

}  // namespace cinch
