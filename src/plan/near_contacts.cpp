#include "plan/near_contacts.hpp"

#include <algorithm>
#include <limits>

#include "kernels/contact_item.hpp"

namespace cinch {
namespace {

/// Of the motion that closes a gap: places round off in each step, so that what flies straight at a ball
/// would be seen a step later than by one who has just woken up, as after a restart.
constexpr double sleep_share = 0.9;
constexpr double motion_per_ball_gap = 2;  ///< balls stand still
constexpr double window_share = 0.03;      ///< of the margin: bench_contact.cpp measures it

kernel::RingLane lane_of(const kernel::Pair& pair, const kernel::RingGeometry& ring, const double* share) {
  const bool held = ring.a == ring.b;
  // a little more than the contact distance: rounding must not hide an end that touches
  const double touch = pair.contact_distance * pair.contact_distance * (1 + 1e-9);
  return {pair.a,
          pair.b,
          ring.a,
          ring.b,
          ring.radius,
          pair.contact_distance,
          pair.stiffness,
          pair.fraction_a > 0 ? touch : 0,
          pair.fraction_b > 0 ? touch : 0,
          plain::multiplicity(pair.fraction_a) * share[pair.a],
          plain::multiplicity(pair.fraction_b) * share[pair.b],
          held ? share[ring.a] : share[ring.a] + share[ring.b],
          held ? 1.0 : 0.0};
}

}  // namespace

void NearContacts::renew(LocalContacts contacts, double margin, const double* share) {
  contacts_ = std::move(contacts);
  ring_tallies_.keep(std::move(contacts_.ring_tallies), contacts_.shared);
  ball_tallies_.keep(std::move(contacts_.ball_tallies), contacts_.shared);
  lanes_.clear();
  for (Index i = 0; i < contacts_.ball_begin; ++i) {
    const kernel::Pair& pair = contacts_.pairs[static_cast<std::size_t>(i)];
    lanes_.push_back(lane_of(pair, contacts_.rings[static_cast<std::size_t>(pair.with)], share));
  }
  scratch_.resize(kernel::ring_scratch);
  window_ = window_share * margin;
  near_until_ = -std::numeric_limits<double>::infinity();
  asleep_.assign(contacts_.pairs.size(), -std::numeric_limits<double>::infinity());
  for (auto* list : {&near_, &awake_}) list->resize(contacts_.pairs.size() + 1);
  sleep_.resize(contacts_.pairs.size());
  loads_.resize(4 * contacts_.pairs.size());
  load_count_ = 0;
}

// All pairs whose sleep ends within the next window of motion.
void NearContacts::find_near(double motion) {
  near_until_ = motion + window_;
  near_count_ = 0;
  for (std::size_t i = 0; i < asleep_.size(); ++i) {
    near_[near_count_] = static_cast<Index>(i);
    near_count_ += asleep_[i] <= near_until_;
  }
}

// Those of the near pairs that could touch now.
void NearContacts::wake(double motion) {
  if (!(motion < near_until_)) find_near(motion);
  std::size_t count = 0;
  for (std::size_t i = 0; i < near_count_; ++i) {
    awake_[count] = near_[i];
    count += asleep_[static_cast<std::size_t>(near_[i])] <= motion;
  }
  awake_count_ = static_cast<Index>(count);
  const auto balls = std::lower_bound(awake_.begin(), awake_.begin() + awake_count_, contacts_.ball_begin);
  awake_rings_ = static_cast<Index>(balls - awake_.begin());
}

std::vector<Index> NearContacts::nodes() const {
  std::vector<Index> nodes;
  for (const kernel::Pair& pair : contacts_.pairs) nodes.insert(nodes.end(), {pair.a, pair.b});
  for (const kernel::RingGeometry& ring : contacts_.rings) nodes.insert(nodes.end(), {ring.a, ring.b});
  return nodes;
}

double NearContacts::asleep_until() const {
  double until = std::numeric_limits<double>::infinity();
  for (const double pair : asleep_) until = std::min(until, pair);
  return until;
}

void NearContacts::evaluate(const NodeView& n, const StepPlan& plan, double time, double booked_dt,
                            double motion) {
  wake(motion);
  kernel::ContactArguments contact{n.x,  n.y,       n.z,    n.vx, n.vy, n.vz, n.share, plan.alpha_ring,
                                   time, booked_dt, plan.dt};
  const kernel::RingArguments rings{
      contact,       contacts_.rings.data(), ring_tallies_.data(), static_cast<Index>(contacts_.rings.size()),
      lanes_.data(), scratch_.data(),        plan.golden,          plan.couple};
  load_count_ = 0;
  if (plan.rings)
    load_count_ = kernels_.ring_contacts(rings, contacts_.pairs.data(), awake_.data(), awake_rings_,
                                         sleep_.data(), loads_.data());
  contact.alpha = plan.alpha_target;
  const kernel::BallArguments balls{contact, contacts_.centers.data(), ball_tallies_.data()};
  if (plan.balls)
    load_count_ += kernels_.ball_contacts(balls, contacts_.pairs.data(), awake_.data() + awake_rings_,
                                          awake_count_ - awake_rings_, sleep_.data() + awake_rings_,
                                          loads_.data() + load_count_);
  evaluated_ += awake_count_;
  for (std::size_t i = 0; i < static_cast<std::size_t>(awake_count_); ++i) {
    const double motions = i < static_cast<std::size_t>(awake_rings_) ? 1.0 : motion_per_ball_gap;
    asleep_[static_cast<std::size_t>(awake_[i])] = motion + sleep_share * motions * sleep_[i];
  }
}

}  // namespace cinch
