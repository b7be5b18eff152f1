// The errors a user can meet, one type for each exit code of the program.
#pragma once
#include <stdexcept>
#include <string>

namespace cinch {

/// Exit codes of the program `cinch`.
enum class ExitCode {
  done = 0,
  internal = 1,      ///< a defect of the program
  usage = 2,         ///< command line or case file
  numerical = 3,     ///< the run went wrong; what was computed so far is kept
  input_output = 4,  ///< file missing, unreadable, disk full
  different = 5,     ///< `cinch compare` found a difference
  interrupted = 130,
  terminated = 143,
};

struct Error : std::runtime_error {
  ExitCode code;
  Error(ExitCode exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
};

/// Bad command line or case file; the message is complete (file:line:column, found, allowed).
struct CaseError : Error {
  explicit CaseError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// The motion cannot be continued: names the item, the time and the likely cause.
struct NumericalError : Error {
  explicit NumericalError(const std::string& message) : Error(ExitCode::numerical, message) {}
};

/// A file could not be read or written.
struct FileError : Error {
  explicit FileError(const std::string& message) : Error(ExitCode::input_output, message) {}
};

}  // namespace cinch
