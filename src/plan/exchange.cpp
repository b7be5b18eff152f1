#include "plan/exchange.hpp"

#include <algorithm>
#include <thread>

#include "base/caught.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr int patient_spins =
    4096;  ///< some microseconds; longer waits mean that the other thread has no core
constexpr std::size_t numbers_in_line = 8;

// Tells the processor that this is a wait.
inline void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

void wait_for(const std::atomic<std::int64_t>& round, std::int64_t wanted) {
  for (int spin = 0; round.load(std::memory_order_acquire) < wanted; ++spin)
    if (spin < patient_spins) relax();
    else std::this_thread::yield();
}

// Asks for a line of memory to write on, which another core has read: asked for when a step begins, it does
// not keep that step's end waiting.
inline void claim(const double* line) {
#if defined(__x86_64__)
  asm volatile("prefetchw %0" : : "m"(*line));
#else
  __builtin_prefetch(line, 1);
#endif
}

}  // namespace

// One for each piece that has nodes which this one needs.
Exchange::Channels Exchange::channels_to(std::size_t receiver,
                                         const std::vector<std::unique_ptr<Piece>>& pieces,
                                         const std::vector<int>& owner,
                                         const std::vector<std::vector<bool>>& moved) {
  const std::vector<Index> ghosts = pieces[receiver]->ghosts(), places = pieces[receiver]->ghost_places();
  Channels channels;
  std::vector<Channel*> from_sender(pieces.size(), nullptr);
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    const auto sender = at(owner[at(ghosts[g])]);
    Channel*& channel = from_sender[sender];
    if (channel == nullptr) {
      channels.push_back(std::make_unique<Channel>());
      channel = channels.back().get();
      channel->sender = static_cast<int>(sender);
      channel->receiver = static_cast<int>(receiver);
    }
    const Index from = pieces[sender]->local(ghosts[g]);
    (moved[sender][at(from)] ? channel->moved : channel->told).push_back({from, places[g]});
  }
  for (const auto& channel : channels)
    for (auto& box : channel->box) box.assign(6 * channel->told.size() + 3 * channel->moved.size(), 0.0);
  return channels;
}

void Exchange::set_up(const std::vector<std::unique_ptr<Piece>>& pieces, const std::vector<int>& owner,
                      bool everyone, double dt) {
  const auto count = pieces.size();
  const int threads = static_cast<int>(count);
  dt_ = dt;
  if (posts_.size() != count) posts_.clear();  // other threads: rounds begin anew
  while (posts_.size() < count) posts_.push_back(std::make_unique<Post>());
  sent_.assign(count, {});
  received_.resize(count);
  partners_.assign(count, {});
  std::vector<std::vector<bool>> moved(count);  // by piece and node
  Caught caught;
#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(static, 1)
    for (std::size_t p = 0; p < count; ++p) caught.run([&] { moved[p] = pieces[p]->moved_by_speed(); });
    const bool complete = !caught.any();
#pragma omp for schedule(static, 1)
    for (std::size_t p = 0; p < count; ++p)
      if (complete) caught.run([&] { received_[p] = channels_to(p, pieces, owner, moved); });
  }
  caught.rethrow();
  for (const Channels& channels : received_)
    for (const auto& channel : channels) {
      sent_[at(channel->sender)].push_back(channel.get());
      partners_[at(channel->sender)].push_back(channel->receiver);
      partners_[at(channel->receiver)].push_back(channel->sender);
    }
  for (std::size_t p = 0; p < count; ++p) {
    if (everyone)
      for (std::size_t q = 0; q < count; ++q) partners_[p].push_back(static_cast<int>(q));
    std::sort(partners_[p].begin(), partners_[p].end());
    partners_[p].erase(std::unique(partners_[p].begin(), partners_[p].end()), partners_[p].end());
    std::erase(partners_[p], static_cast<int>(p));
  }
}

void Exchange::post(int p, Piece& piece, double greatest) {
  Post& mine = *posts_[at(p)];
  const std::int64_t round = mine.round.load(std::memory_order_relaxed) + 1;
  const auto side = static_cast<std::size_t>(round & 1);
  for (Channel* const channel : sent_[at(p)]) {
    double* box = channel->box[side].data();
    const auto put = [&](const double* field, const std::vector<Passage>& nodes) {
      for (const Passage& node : nodes) *box++ = field[node.from];
    };
    for (std::size_t f = 3; f < 6; ++f) put(piece.field(f), channel->moved);
    for (std::size_t f = 0; f < 6; ++f) put(piece.field(f), channel->told);
  }
  mine.greatest[side] = greatest;
  mine.round.store(round, std::memory_order_release);
}

// Takes over what a mailbox holds.
void Exchange::open(const Channel& channel, const double* box, Piece& piece) const {
  for (std::size_t f = 0; f < 3; ++f) {
    double *const place = piece.field(f), *const speed = piece.field(f + 3);
    for (const Passage& node : channel.moved) {
      speed[node.to] = *box++;
      place[node.to] += dt_ * speed[node.to];
    }
  }
  for (std::size_t f = 0; f < 6; ++f) {
    double* const field = piece.field(f);
    for (const Passage& node : channel.told) field[node.to] = *box++;
  }
}

double Exchange::meet(int p, Piece& piece, double greatest) {
  const std::int64_t round = posts_[at(p)]->round.load(std::memory_order_relaxed);
  const auto side = static_cast<std::size_t>(round & 1);
  for (const int q : partners_[at(p)]) {
    wait_for(posts_[at(q)]->round, round);
    greatest = std::max(greatest, posts_[at(q)]->greatest[side]);
  }
  for (const auto& channel : received_[at(p)])  // all lines at once
    for (std::size_t k = 0; k < channel->box[side].size(); k += numbers_in_line)
      __builtin_prefetch(&channel->box[side][k]);
  for (const auto& channel : received_[at(p)]) open(*channel, channel->box[side].data(), piece);
  for (const Channel* channel : sent_[at(p)]) {  // those of the next round
    const AlignedVector<double>& box = channel->box[1 - side];
    for (std::size_t k = 0; k < box.size(); k += numbers_in_line) claim(&box[k]);
  }
  return greatest;
}

}  // namespace cinch
