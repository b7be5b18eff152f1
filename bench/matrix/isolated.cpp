// The outcome comes back as JSON through a pipe.
#include "isolated.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>

namespace cinch::matrix {
namespace {

std::string packed(const Outcome& outcome) {
  return nlohmann::json{{"verdict", static_cast<int>(outcome.verdict)},
                        {"residual", outcome.residual},
                        {"steps", outcome.steps},
                        {"message", outcome.message}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Outcome unpacked(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  return {static_cast<Verdict>(json.at("verdict").get<int>()),
          json.at("residual").is_null() ? std::numeric_limits<double>::quiet_NaN()
                                        : json.at("residual").get<double>(),
          json.at("steps").get<std::int64_t>(), json.at("message").get<std::string>()};
}

Outcome failed(const std::string& why) { return {Verdict::failed, 0, 0, why}; }

[[noreturn]] void child(const std::function<Outcome()>& run, int pipe_end) {
  std::string text;
  try {
    text = packed(run());
  } catch (const std::exception& error) {
    text = packed(failed(std::string("an error of no kind that is known: ") + error.what()));
  }
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(pipe_end, text.data() + done, text.size() - done);
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  _exit(0);
}

/// All that comes until the other end closes; false when time is up.
bool read_all(int pipe_end, int seconds, std::string& text) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(seconds);
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd waiting{pipe_end, POLLIN, 0};
    if (left <= 0 || poll(&waiting, 1, static_cast<int>(left)) == 0) return false;
    char buffer[4096];
    const ssize_t count = read(pipe_end, buffer, sizeof buffer);
    if (count <= 0) return true;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

}  // namespace

Outcome isolated(const std::function<Outcome()>& run, int seconds) {
  int ends[2];
  if (pipe(ends) != 0) return failed("no pipe");
  const pid_t process = fork();
  if (process < 0) return failed("no process");
  if (process == 0) {
    close(ends[0]);
    child(run, ends[1]);
  }
  close(ends[1]);
  std::string text;
  const bool done = read_all(ends[0], seconds, text);
  if (!done) kill(process, SIGKILL);
  close(ends[0]);
  int status = 0;
  waitpid(process, &status, 0);
  if (!done) return failed("not done after " + std::to_string(seconds) + " s");
  if (WIFSIGNALED(status)) return failed("crashed by signal " + std::to_string(WTERMSIG(status)));
  return text.empty() ? failed("ended without a word") : unpacked(text);
}

}  // namespace cinch::matrix
