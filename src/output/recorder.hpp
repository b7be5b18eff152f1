// Writes a run as it happens: DIR/run.vtkhdf, DIR/run.xdmf (rings.xdmf, ways.xdmf, balls.xdmf) and, at the
// end, DIR/summary.json.
#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "base/result.hpp"
#include "output/result_reader.hpp"

namespace cinch {

/// Appends frames and probe rows to a result file. What has been handed over to it is complete on disk,
/// whatever happens next; it can be read while it grows. All calls from one thread at a time. Every function
/// throws FileError when the disk refuses.
class Recorder {
 public:
  struct Options {
    bool compress = false;  ///< shuffle + deflate 1: about a quarter less disk for much time
    double patience = 0;    ///< s of run time that frames and probe rows may wait to be handed over together
    // Those that are expected: as long as there are no more, a kill at no moment can hide any.
    std::int64_t frames = 0, probe_rows = 0;
    std::string run_id = {};  ///< of the run that it tells of, for Result::run_id
  };
  /// The part of a result from which a run goes on.
  struct Earlier {
    const Result& result;
    int frames = 0;
    std::size_t probe_rows = 0;
  };

  /// Creates `directory` and DIR/run.vtkhdf; an old run's files of the same names are removed first (whether
  /// that is allowed is the caller's business).
  Recorder(const std::filesystem::path& directory, ResultModel model, const Options& options);
  /// Begins with frames and probe rows of `earlier`, which may lie in `directory`: it is replaced when the
  /// disk has them all in the new file, as is an old run there, with all its files. Throws FileError where it
  /// has fewer.
  Recorder(const std::filesystem::path& directory, ResultModel model, const Options& options,
           const Earlier& earlier);
  Recorder(const Recorder&) = delete;
  ~Recorder();  ///< without finish(): hands over all, writes no summary, reports no errors

  /// Appends one frame; its arrays must have the model's sizes (else Error, internal). Hands over what waits,
  /// unless all of it may go on waiting.
  void frame(const Frame& frame);
  /// One row of the probe table at `time` (s): model.probes.size() values.
  void probes(double time, std::span<const double> values);
  /// Hands over what has waited for longer than `patience`: to be called now and then.
  void catch_up();
  /// Returns when the disk has all that was recorded, for a checkpoint that counts on it.
  void sync();
  /// Events and summary into the file, then XDMF and summary.json. Nothing may be recorded afterwards.
  void finish(const Summary& summary);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cinch
