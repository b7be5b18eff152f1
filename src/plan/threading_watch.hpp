// Watches that threads stay in the rings that they pass through by contact.
//
// A thread passes a ring as often as its centre line goes through the disc inside the wire's centre line: to
// the one side counts 1, to the other -1. Bends of the thread change nothing in the sum; what does is an end
// drawn through the opening, or a thread that has gone through the wire.
#pragma once
#include <vector>

#include "plan/contact_list.hpp"
#include "plan/look.hpp"

namespace cinch {

class ThreadingWatch {
 public:
  /// A thread that passes through a ring no longer as it did when it was first looked at.
  struct Loss {
    Index ring, part;
    Index before, now;  ///< times through
  };

  /// Also watches, from now on, the threads that pass through a ring in this look and were not there before.
  /// `contacts`: those of that look; what goes through a ring is near it.
  void begin(const Look& now, const ContactList& contacts);
  /// Those lost since the last look, which is some thousand steps ago or more (else it does not look again);
  /// they are watched no more.
  std::vector<Loss> losses(const Look& now, const ContactList& contacts);
  bool empty() const { return watched_.empty(); }
  /// `elements`: those of the scene now.
  void transfer(Archive& archive, const Assembly& assembly, Index elements);

 private:
  struct Watched {
    Index ring, part, times;
  };
  std::vector<Watched> watched_;
  Index elements_ = 0;     ///< of the scene, when it was last looked at for threads
  std::int64_t next_ = 0;  ///< step of the next look
};

}  // namespace cinch
