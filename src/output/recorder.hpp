// Writes a run as it happens: DIR/run.vtkhdf, DIR/run.xdmf (rings.xdmf, balls.xdmf) and, at the end,
// DIR/summary.json.
#pragma once
#include <filesystem>
#include <memory>
#include <span>

#include "base/result.hpp"

namespace cinch {

/// Appends frames and probe rows to a result file. After each frame() the file on disk is complete up to that
/// frame, whatever happens next; it can be read while it grows. All calls from one thread at a time.
/// Every function throws FileError when the disk refuses.
class Recorder {
 public:
  /// Creates `directory` and DIR/run.vtkhdf; an old run's files of the same names are removed first (whether
  /// that is allowed is the caller's business). `compress`: shuffle + deflate 1, about a quarter less disk
  /// for much time.
  Recorder(const std::filesystem::path& directory, ResultModel model, bool compress);
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  ~Recorder();  ///< without finish(): keeps frames and probes, writes no summary, reports no errors

  /// Appends and flushes one frame; its arrays must have the model's sizes (else Error, internal).
  void frame(const Frame& frame);
  /// One row of the probe table at `time` (s): model.probes.size() values. Kept in memory until the next
  /// frame.
  void probes(double time, std::span<const double> values);
  /// Events and summary into the file, then XDMF and summary.json. Nothing may be recorded afterwards.
  void finish(const Summary& summary);

  int frames() const;
  const std::filesystem::path& directory() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cinch
