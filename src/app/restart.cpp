#include "app/restart.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <random>

#include "base/error.hpp"
#include "base/version.hpp"
#include "output/result_layout.hpp"

namespace cinch::app {
namespace {

namespace fs = std::filesystem;

// What the motion so far does not hang on.
constexpr std::array changeable{"time.end_s",
                                "time.end_when",
                                "time.end_delay_s",
                                "time.speed_limit_m_s",
                                "time.residual_limit",
                                "output.checkpoint",
                                "output.checkpoint_interval_s",
                                "output.checkpoint_run_time_s"};

void require_changeable(const Override& change) {
  if (std::find(changeable.begin(), changeable.end(), change.key) != changeable.end()) return;
  std::string allowed;
  for (const char* key : changeable) allowed += (allowed.empty() ? "" : ", ") + std::string(key);
  throw CaseError("error: --set " + change.key + "=" + change.value +
                  ": a run that goes on keeps its case; allowed: " + allowed);
}

// Where the program that wrote a checkpoint came from.
std::string writer(Archive& archive) {
  std::string version = cinch::version, commit = cinch::commit;
  archive.text("written_by/version", version);
  archive.text("written_by/commit", commit);
  return version + " (" + commit + ")";
}

}  // namespace

void SavedCase::transfer(Archive& archive) {
  archive.text("case/name", name);
  archive.text("case/toml", toml);
}

void Account::transfer(Archive& archive) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (archive.holds("account/run_id")) archive.text("account/run_id", run_id);
  archive.whole("account/frames", frames, 0, most);
  archive.whole("account/probe_rows", probe_rows, 0, most);
  archive.value("account/run_time", run_time);
  archive.value("account/observing", observing);
  archive.value("account/writing", writing);
}

std::string new_run_id() {
  std::random_device random;
  char text[17];
  std::snprintf(text, sizeof text, "%08x%08x", random(), random());
  return text;
}

Restart::Restart(const fs::path& path)
    : checkpoint_(path),
      folder_(checkpoint_.path().has_parent_path() ? checkpoint_.path().parent_path() : fs::path(".")),
      earlier_(folder_) {
  require_same_run();
}

void Restart::require_same_run() {
  Account saved;
  saved.transfer(checkpoint_);
  if (saved.run_id.empty() || saved.run_id == earlier_.run_id()) return;
  throw FileError("error: " + checkpoint_.path().string() + ": does not belong to " +
                  earlier_.path().string() +
                  ", which is of another run\n    put it beside the result of its own run, or run the case "
                  "anew");
}

Scene Restart::scene(const std::vector<Override>& overrides) {
  for (const Override& change : overrides) require_changeable(change);
  SavedCase saved;
  saved.transfer(checkpoint_);
  return parse_case(saved.toml, saved.name + ".toml", overrides);
}

void Restart::require_later(const Simulation& simulation) const {
  const std::int64_t step = simulation.step(), end = simulation.end_step();
  if (step < end) return;
  const Timeline& timeline = simulation.preparation().timeline;
  const bool early = end < simulation.preparation().end_step;
  char text[400];
  std::snprintf(text, sizeof text, "error: %s stands at %.9g s, and the case ends at %.9g s%s; to go on %s",
                checkpoint_.path().c_str(), timeline.time_of(step), timeline.time_of(end),
                early ? ", as its mouth has closed" : "",
                early ? "take --set time.end_when=never, or a longer time.end_delay_s"
                      : "give a later end: --set time.end_s=SECONDS");
  throw CaseError(text);
}

std::string Restart::doubt() {
  const std::string here = std::string(cinch::version) + " (" + cinch::commit + ")";
  const std::string there = writer(checkpoint_);
  return here == there ? ""
                       : "the checkpoint was written by cinch " + there + ", this is " + here +
                             ": the last bits may differ from those of one run";
}

void write_checkpoint(const fs::path& folder, SavedCase scene, Account account, Simulation& simulation) {
  CheckpointWriter file(folder / layout::kCheckpointFile);
  writer(file);
  scene.transfer(file);
  account.transfer(file);
  simulation.save(file);
  file.commit();
}

}  // namespace cinch::app
