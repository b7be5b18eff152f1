#include "app/resources.hpp"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "scene/extent.hpp"

namespace cinch::app {
namespace {

bool out_of_memory() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
  }
  return false;
}

std::terminate_handler usual = nullptr;

void on_terminate() {
  if (!out_of_memory()) usual();
  constexpr std::string_view text = "error: not enough memory\n";
  static_cast<void>(!write(STDERR_FILENO, text.data(), text.size()));
  _exit(static_cast<int>(ExitCode::input_output));  // other threads are in the midst of a step
}

}  // namespace

void warn_of_threads(int threads) {
  const int processors = omp_get_num_procs();
  if (std::min(threads, omp_get_thread_limit()) <= processors) return;
  std::cerr << "warning: --threads " << threads << ": this process may use " << processors << " processor"
            << (processors == 1 ? "" : "s") << "; more threads than that wait for each other\n";
}

void refuse_for_memory(const Scene& scene) {
  const Extent extent = extent_of(scene);
  throw Error(ExitCode::input_output, "error: not enough memory for this scene (" +
                                          std::to_string(extent.nodes) + " nodes, " +
                                          std::to_string(extent.elements) + " elements)");
}

void watch_memory_of_threads() { usual = std::set_terminate(on_terminate); }

}  // namespace cinch::app
