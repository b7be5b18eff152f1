// An exception must not leave a region of threads: it would end the program. It is caught inside and thrown
// again behind the region.
#pragma once
#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

namespace cinch {

class Caught {
 public:
  /// Runs `work`, by any thread; keeps what it throws, the first of all.
  template <class Work>
  void run(Work work) noexcept {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!any_.exchange(true)) first_ = std::current_exception();
    }
  }
  /// Whether something was caught so far.
  bool any() const { return any_; }
  /// Behind the region.
  void rethrow() {
    if (first_) std::rethrow_exception(std::exchange(first_, nullptr));
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
  std::atomic<bool> any_{false};
};

}  // namespace cinch
