#include "plan/contact_list.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/caught.hpp"
#include "kernels/contact_law.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Rings: a region of threads costs as much as the search for some.
constexpr std::size_t worth_sharing = 64;

constexpr double margin_lengths = 4;  ///< automatic margin over the mean element length of the finest set

double automatic_margin(const Model& model) {
  double margin = std::numeric_limits<double>::infinity();
  for (const ContactSet& set : model.contact_sets) {
    double sum = 0;
    for (const Index e : set.elements) sum += model.rest_length[at(e)];
    if (!set.elements.empty())
      margin = std::min(margin, margin_lengths * sum / static_cast<double>(set.elements.size()));
  }
  return margin;
}

kernel::Pair pair_of(const Model& model, const ContactSet& set, Index position, Index with,
                     double other_radius, double curvature_radius, double other_compliance) {
  const Index e = set.elements[at(position)];
  return {model.end_a[at(e)],
          model.end_b[at(e)],
          e,
          with,
          model.radius[at(e)] + other_radius,
          plain::contact_stiffness(model.radius[at(e)], curvature_radius, model.compliance[at(e)],
                                   other_compliance),
          set.fraction_a[at(position)],
          set.fraction_b[at(position)]};
}

kernel::Pair pair_with_ring(const Model& model, Index position, std::size_t r) {
  return pair_of(model, model.contact_sets[at(model.ring_set[r])], position, static_cast<Index>(r),
                 model.ring_wire_radius[r], model.ring_wire_radius[r], model.ring_compliance[r]);
}

kernel::Pair pair_with_ball(const Model& model, Index position, std::size_t b) {
  const Model::Ball& ball = model.balls[b];
  return pair_of(model, model.contact_sets[at(ball.set)], position, static_cast<Index>(b), ball.radius,
                 ball.radius, ball.compliance);
}

// A sphere is an element without length: both ends are its node.
kernel::Pair pair_of(const Model::Sphere& sphere, Index with, const Model::Ball& ball) {
  return {sphere.node,
          sphere.node,
          kernel::sphere_label(sphere.node),
          with,
          sphere.radius + ball.radius,
          plain::contact_stiffness(sphere.radius, ball.radius, sphere.compliance, ball.compliance),
          0,
          0};
}

Vec3 ring_center(const State& state, const kernel::RingGeometry& ring) {
  const auto a = at(ring.a), b = at(ring.b);
  return 0.5 * Vec3(state.x[a] + state.x[b], state.y[a] + state.y[b], state.z[a] + state.z[b]);
}

double distance(const State& state, Index a, Index b) {
  return Vec3(state.x[at(b)] - state.x[at(a)], state.y[at(b)] - state.y[at(a)],
              state.z[at(b)] - state.z[at(a)])
      .norm();
}

// Position of an element in the set.
Index position_in(const Archive& archive, const ContactSet& set, Index element) {
  const auto found = std::lower_bound(set.elements.begin(), set.elements.end(), element);
  if (found == set.elements.end() || *found != element)
    archive.refuse("contacts/element", "names an element that has no such contact");
  return static_cast<Index>(found - set.elements.begin());
}

kernel::Pair restored_with_ball(const Archive& archive, const Model& model, Index touching, std::size_t b) {
  const Model::Ball& ball = model.balls[b];
  if (touching >= 0)
    return pair_with_ball(model, position_in(archive, model.contact_sets[at(ball.set)], touching), b);
  for (const Model::Sphere& sphere : ball.spheres)
    if (sphere.node == kernel::sphere_label(touching)) return pair_of(sphere, static_cast<Index>(b), ball);
  archive.refuse("contacts/element", "names a mass that has no such contact");
}

kernel::BallTally untouched() {
  kernel::BallTally tally{};
  tally.first_time = -1;
  tally.stiffest_element = -1;
  return tally;
}

// Tallies of pairs that are over as one, in their order; then one for each of the new pairs.
void begin_tallies(std::vector<kernel::BallTally>& tallies, std::size_t pairs) {
  kernel::BallTally sum = untouched();
  for (const kernel::BallTally& t : tallies) {
    sum.dissipated += t.dissipated;
    for (int d = 0; d < 3; ++d) {
      sum.impulse[d] += t.impulse[d];
      sum.moment[d] += t.moment[d];
    }
    sum.max_penetration = std::max(sum.max_penetration, t.max_penetration);
    if (t.first_time >= 0 && (sum.first_time < 0 || t.first_time < sum.first_time))
      sum.first_time = t.first_time;
    if (t.stiffest > sum.stiffest) {
      sum.stiffest = t.stiffest;
      sum.stiffest_time = t.stiffest_time;
      sum.stiffest_element = t.stiffest_element;
    }
  }
  tallies.assign(pairs + 1, untouched());
  tallies.front() = sum;
}

}  // namespace

ContactList::ContactList(const Model& model, double margin, int threads)
    : margin_(margin > 0 ? margin : automatic_margin(model)),
      trees_(model.contact_sets.size()),
      searches_(at(threads)) {}

void ContactList::rebuild(const Model& model, State& state) {
  ++rebuilds_;
  for (std::size_t s = 0; s < trees_.size(); ++s)
    trees_[s].build(model, model.contact_sets[s], state, static_cast<int>(searches_.size()));
  find_ring_pairs(model, state);
  find_ball_pairs(model, state);
  find_longest_approach();
  measure_hosts(model, state, 0);
  for (std::size_t b = 0; b < model.balls.size(); ++b)
    begin_tallies(state.balls[b], at(ball_begin[b + 1] - ball_begin[b]));
}

void ContactList::transfer(Archive& archive, const Model& model) {
  std::vector<Index> touching;  // of each pair, as pairs name it
  for (const kernel::Pair& pair : pairs) touching.push_back(pair.element);
  archive.wholes("contacts/element", touching, kernel::sphere_label(model.nodes - 1), model.elements - 1);
  const auto most = static_cast<std::int64_t>(touching.size());
  archive.wholes("contacts/ring_begin", ring_begin, 0, most);
  archive.wholes("contacts/target_begin", ball_begin, 0, most);
  if (!archive.restoring()) return;
  require_ranges(archive, model, most);
  pairs.clear();
  for (std::size_t r = 0; r < model.rings.size(); ++r)
    for (Index i = ring_begin[r]; i < ring_begin[r + 1]; ++i)
      pairs.push_back(pair_with_ring(
          model, position_in(archive, model.contact_sets[at(model.ring_set[r])], touching[at(i)]), r));
  for (std::size_t b = 0; b < model.balls.size(); ++b)
    for (Index i = ball_begin[b]; i < ball_begin[b + 1]; ++i)
      pairs.push_back(restored_with_ball(archive, model, touching[at(i)], b));
  find_longest_approach();
}

void ContactList::find_longest_approach() {
  longest_approach_ = std::numeric_limits<double>::infinity();
  for (const kernel::Pair& pair : pairs)
    longest_approach_ = std::min(longest_approach_, jump_share * pair.contact_distance);
}

void ContactList::measure_hosts(const Model& model, const State& state, double motion) {
  greatest_turning_ = inverse_shortest_host_ = 0, measured_at_ = motion;
  for (std::size_t r = 0; r < model.rings.size(); ++r) {
    const kernel::RingGeometry& ring = model.rings[r];
    if (ring.a == ring.b || ring_begin[r] == ring_begin[r + 1]) continue;
    const double inverse = 1 / distance(state, ring.a, ring.b);  // infinite where it is folded to a point
    greatest_turning_ = std::max(greatest_turning_, ring.radius * inverse);
    inverse_shortest_host_ = std::max(inverse_shortest_host_, inverse);
  }
}

// A host of length L is at least L - m long after a motion m: R / (L - m) is (R / L) / (1 - m / L) at most.
bool ContactList::may_jump(double approach, double motion) const {
  const double left = 1 - (motion - measured_at_) * inverse_shortest_host_;
  return !(left > 0 && approach * (left + greatest_turning_) <= longest_approach_ * left);
}

// Rings' pairs first, then those of the balls, without gaps.
void ContactList::require_ranges(const Archive& archive, const Model& model, std::int64_t pair_count) const {
  const bool whole = ring_begin.size() == model.rings.size() + 1 &&
                     ball_begin.size() == model.balls.size() + 1 && ring_begin.front() == 0 &&
                     ring_begin.back() == ball_begin.front() && ball_begin.back() == pair_count &&
                     std::is_sorted(ring_begin.begin(), ring_begin.end()) &&
                     std::is_sorted(ball_begin.begin(), ball_begin.end());
  if (!whole) archive.refuse("contacts", "does not fit the rings and targets of the case");
}

std::int64_t ContactList::pairs_tested() const {
  std::int64_t sum = 0;
  for (const Search& search : searches_) sum += search.tested;
  return sum;
}

void ContactList::find_near_ring(const Model& model, const State& state, std::size_t r, Search& search,
                                 std::vector<kernel::Pair>& found) const {
  const auto set_number = at(model.ring_set[r]);
  search.positions.clear();
  trees_[set_number].query(model, model.contact_sets[set_number], state, ring_center(state, model.rings[r]),
                           model.rings[r].reach + margin_, search.positions, search.tested);
  for (const Index position : search.positions) found.push_back(pair_with_ring(model, position, r));
}

// Each thread takes some of the rings, one after another; what all but the first find is put behind.
void ContactList::find_ring_pairs(const Model& model, const State& state) {
  const std::size_t rings = model.rings.size(), shares = rings < worth_sharing ? 1 : searches_.size();
  const int threads = static_cast<int>(shares);
  ring_begin.assign(rings + 1, 0);
  Caught caught;
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
  for (std::size_t share = 0; share < shares; ++share)
    caught.run([&] {
      Search& search = searches_[share];
      std::vector<kernel::Pair>& found = share == 0 ? pairs : search.pairs;
      found.clear();
      for (std::size_t r = rings * share / shares; r < rings * (share + 1) / shares; ++r) {
        const std::size_t before = found.size();
        find_near_ring(model, state, r, search, found);
        ring_begin[r + 1] = static_cast<Index>(found.size() - before);
      }
    });
  caught.rethrow();
  std::partial_sum(ring_begin.begin(), ring_begin.end(), ring_begin.begin());
  for (std::size_t share = 1; share < shares; ++share)
    pairs.insert(pairs.end(), searches_[share].pairs.begin(), searches_[share].pairs.end());
}

void ContactList::find_ball_pairs(const Model& model, const State& state) {
  ball_begin.assign(1, static_cast<Index>(pairs.size()));
  Search& search = searches_.front();
  for (std::size_t b = 0; b < model.balls.size(); ++b) {
    const Model::Ball& ball = model.balls[b];
    const auto with = static_cast<Index>(b);
    const ContactSet& set = model.contact_sets[at(ball.set)];
    search.positions.clear();
    trees_[at(ball.set)].query(model, set, state, ball.center, ball.radius + set.thickest + margin_,
                               search.positions, search.tested);
    for (const Index position : search.positions) pairs.push_back(pair_with_ball(model, position, b));
    for (const Model::Sphere& sphere : ball.spheres)
      if (distance_to_element(state, sphere.node, sphere.node, ball.center) <=
          ball.radius + sphere.radius + margin_)
        pairs.push_back(pair_of(sphere, with, ball));
    ball_begin.push_back(static_cast<Index>(pairs.size()));
  }
}

}  // namespace cinch
