// What `cinch run --restart` goes on from: a checkpoint and the result that it belongs to.
#pragma once
#include "app/commands.hpp"
#include "output/checkpoint.hpp"
#include "output/result_reader.hpp"
#include "plan/simulation.hpp"

namespace cinch::app {

/// The case as a run was given it.
struct SavedCase {
  std::string name, toml;  ///< toml: resolved
  void transfer(Archive& archive);
};

/// How far a run had come, apart from its simulation.
struct Account {
  std::string run_id;                               ///< empty where an earlier version saved it
  std::int64_t frames = 0, probe_rows = 0;          ///< recorded because they were due
  double run_time = 0, observing = 0, writing = 0;  ///< s
  void transfer(Archive& archive);
};

/// One for each run, by chance.
std::string new_run_id();

class Restart {
 public:
  /// Throws FileError for what is no checkpoint, or has no result beside it, or another run's.
  explicit Restart(const std::filesystem::path& path);

  /// The case of the checkpoint with `overrides`; CaseError for one that the motion would have to know.
  Scene scene(const std::vector<Override>& overrides);
  /// Throws CaseError where the simulation that goes on from it stands at its end already.
  void require_later(const Simulation& simulation) const;
  const std::filesystem::path& folder() const { return folder_; }
  Archive& archive() { return checkpoint_; }
  const Result& earlier() const { return earlier_; }
  /// A warning, where another version of the program has written it; else empty.
  std::string doubt();

 private:
  void require_same_run();
  CheckpointReader checkpoint_;
  std::filesystem::path folder_;
  Result earlier_;
};

/// Writes FOLDER/checkpoint.h5.
void write_checkpoint(const std::filesystem::path& folder, SavedCase scene, Account account,
                      Simulation& simulation);

}  // namespace cinch::app
