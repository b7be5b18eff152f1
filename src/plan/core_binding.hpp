// Threads on cores of their own, where they are as many as the process may use: threads that wait for each
// other in every step must not share a core while another program has one to itself, as a scheduler that
// knows nothing of their waiting lets them. With fewer threads than cores the scheduler knows better which
// are free, and whoever sets OMP_PROC_BIND has decided.
#pragma once

namespace cinch {

/// Whether so many threads can be bound.
bool can_bind(int threads);

/// Binds the calling thread of a parallel region, number `thread` of `threads`, for as long as it lives, if
/// `wanted` and possible. Threads other than the first stay bound.
class CoreBinding {
 public:
  CoreBinding(bool wanted, int thread, int threads);
  ~CoreBinding();
  CoreBinding(const CoreBinding&) = delete;
  CoreBinding& operator=(const CoreBinding&) = delete;

 private:
  bool restore_ = false;  ///< threads that the first one starts later would begin on its core
};

}  // namespace cinch
