// How the pieces of a scene tell each other what they have moved: one meeting a step, without a barrier.
//
// After a step a thread copies those of its nodes that others have as ghosts into mailboxes and posts the
// number of the round; the others wait for that post and take what is theirs. Mailboxes and posts exist
// twice: who posts round r has seen round r - 1 of all that read from it, so nobody can still be reading
// round r - 2.
//
// What goes through mailboxes goes from cache to cache, which takes longer than to compute it. So of nodes
// that a step just moves, x += dt v, speeds alone are told; whoever has them as ghosts does that addition, to
// the same bits.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "plan/piece.hpp"

namespace cinch {

class Exchange {
 public:
  /// Lays out the mailboxes; `owner` by node. Call again when ghosts have changed. `everyone`: each thread
  /// waits for all others and learns their greatest speeds; else only for those that it shares nodes with.
  /// `dt`: of the pieces' steps, s.
  void set_up(const std::vector<std::unique_ptr<Piece>>& pieces, const std::vector<int>& owner, bool everyone,
              double dt);

  /// Hands over what thread `p` has moved, and the greatest squared speed that it saw.
  void post(int p, Piece& piece, double greatest);
  /// Waits for the others' posts of the same round and takes over ghosts; the greatest squared speed of all.
  double meet(int p, Piece& piece, double greatest);

 private:
  struct alignas(128) Post {
    std::atomic<std::int64_t> round{0};
    double greatest[2]{};
  };
  struct Passage {
    Index from, to;  ///< of one node, local
  };
  // Nodes that one piece has from another. A mailbox holds the speeds of those that a step just moves, then
  // places and speeds of the others.
  struct Channel {
    int sender = 0, receiver = 0;
    std::vector<Passage> moved, told;
    AlignedVector<double> box[2];
  };

  using Channels = std::vector<std::unique_ptr<Channel>>;

  static Channels channels_to(std::size_t receiver, const std::vector<std::unique_ptr<Piece>>& pieces,
                              const std::vector<int>& owner, const std::vector<std::vector<bool>>& moved);
  void open(const Channel& channel, const double* box, Piece& piece) const;

  double dt_ = 0;
  std::vector<std::unique_ptr<Post>> posts_;
  std::vector<Channels> received_;           ///< by receiver
  std::vector<std::vector<Channel*>> sent_;  ///< by sender
  std::vector<std::vector<int>> partners_;   ///< whom a thread waits for
};

}  // namespace cinch
