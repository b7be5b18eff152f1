// The program `cinch`: reads the command line and calls one command.
#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <new>
#include <system_error>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "input/nearest_key.hpp"

namespace {

namespace fs = std::filesystem;
using cinch::app::CaseArguments;

// "key.path=value" to an override; CLI11 reports the message with exit code 2.
cinch::Override parse_override(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw cinch::CaseError("error: --set " + text + ": expected key.path=value");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

struct Options {
  cinch::app::RunArguments run;
  std::vector<std::string> sets;
  cinch::app::CheckOptions check;
  std::vector<fs::path> results;
  cinch::app::ReportArguments report;
};

CLI::Option* add_case(CLI::App& command, Options& options) {
  CLI::Option* const file = command.add_option("CASE", options.run.scene.file, "case file (TOML)");
  command
      .add_option("--set", options.sets,
                  "override a key of the case: key.path=value; thread.*.KEY=value for all threads")
      ->allow_extra_args(false);
  command
      .add_option("--threads", options.run.scene.threads, "threads (default: as many as pay for the scene)")
      ->check(CLI::Range(1, 4096))
      ->envname("CINCH_THREADS");
  return file;
}

// A flag that is there or not: --error=0.01 would be taken for "no" without a word.
CLI::Option* add_switch(CLI::App& command, const std::string& name, bool& value, const std::string& words) {
  return command.add_flag(name, value, words)->disable_flag_override();
}

struct Commands {
  CLI::App *run, *check, *info, *report, *compare;
};

Commands define(CLI::App& app, Options& options) {
  app.set_version_flag("--version", std::string("cinch ") + cinch::version + " (" + cinch::commit + ", " +
                                        cinch::compiler + ")");
  app.require_subcommand(1);
  Commands c{app.add_subcommand("run", "simulate a case"),
             app.add_subcommand("check", "validate a case and say what it would do"),
             app.add_subcommand("info", "what is in a result"),
             app.add_subcommand("report", "one HTML page from one or several results"),
             app.add_subcommand("compare", "compare two results: bits, then differences (exit code 5)")};
  CLI::Option* const file = add_case(*c.run, options);
  c.run
      ->add_option(
          "--restart", options.run.restart,
          "go on from a checkpoint or the results it lies in; --set only what the motion does not know")
      ->excludes(file);
  c.run->final_callback([&options] {
    if (options.run.scene.file.empty() && options.run.restart.empty()) throw CLI::RequiredError("CASE");
  });
  c.run->add_option("--out", options.run.out,
                    "folder for the results (default: results/NAME, or the first free results/NAME-K)");
  add_switch(*c.run, "--overwrite", options.run.overwrite, "replace a result that is there already");
  add_switch(*c.run, "--quiet", options.run.quiet, "no progress, no verdict");
  add_case(*c.check, options)->required();
  add_switch(*c.check, "--resolved", options.check.resolved, "print the case with every default written out");
  CLI::Option* const error =
      add_switch(*c.check, "--error", options.check.error,
                 "run the case and finer ones beside it (eight times its run time): how far it is from them");
  c.check->add_option("--runs", options.check.runs, "runs of each whose means are compared (default: 1)")
      ->check(CLI::Range(1, 1000))
      ->needs(error);
  c.info->add_option("RESULT", options.results, "folder or .vtkhdf file")->required()->expected(1);
  c.report
      ->add_option("RESULT", options.report.results, "folders or .vtkhdf files, the one to begin with first")
      ->required();
  c.report->add_option("--html", options.report.html,
                       "page to write (default: report.html beside the first RESULT); files that are none of "
                       "cinch report's are never replaced");
  c.report->add_option("--table", options.report.table, "Markdown file for the table of the paper's numbers");
  c.report->add_option("--open", options.report.open, "runs with inputs changed that the paper leaves open");
  c.report->add_option("--again", options.report.again,
                       "captures once more, begun a little otherwise: numbers are medians then");
  c.compare->add_option("RESULT", options.results, "two folders or .vtkhdf files")->required()->expected(2);
  return c;
}

// "--error=0.01" where a word of the command line gives a value to a flag: CLI11 says little of it, and
// nothing of "--error=true".
std::string switch_with_value(const CLI::App& app, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], name = word.substr(0, word.find('='));
    if (name == word) continue;
    for (const CLI::App* command : app.get_subcommands())
      for (const CLI::Option* option : command->get_options())
        if (option->check_name(name) && option->get_disable_flag_override()) return word;
  }
  return "";
}

// What is wrong with the command line. CLI11 only says that a sub-command is required: name the nearest one.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (const std::string word = switch_with_value(app, argc, argv); !word.empty())
    return word + ": " + word.substr(0, word.find('=')) + " takes no value";
  if (argc < 2 || argv[1][0] == '-') return error.what();
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return error.what();
  const std::string nearest = cinch::nearest_key(argv[1], names);
  return "unknown command '" + std::string(argv[1]) + "'" +
         (nearest.empty() ? "; allowed: " + cinch::list_of(names) : "; did you mean '" + nearest + "'?");
}

// Messages that name a place in a file hold the word behind it.
void print_error(const std::string& message) {
  const std::string first = message.substr(0, message.find('\n'));
  std::cerr << (first.find("error: ") == std::string::npos ? "error: " : "") << message << "\n";
}

int dispatch(const Commands& c, Options& options) {
  for (const std::string& set : options.sets) options.run.scene.overrides.push_back(parse_override(set));
  if (*c.run) return cinch::app::run(options.run);
  if (*c.check) return cinch::app::check(options.run.scene, options.check);
  if (*c.info) return cinch::app::info(options.results[0]);
  if (*c.report) return cinch::app::report(options.report);
  return cinch::app::compare(options.results[0], options.results[1]);
}

int parse_and_dispatch(int argc, char** argv) {
  CLI::App app{"Cinch: dynamics of tether-nets that capture space debris"};
  Options options;
  const Commands commands = define(app, options);
  try {
    app.parse(argc, argv);
    if (const std::string word = switch_with_value(app, argc, argv); !word.empty())
      throw CLI::ArgumentMismatch(word);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    print_error(usage_error(app, error, argc, argv));
    std::cerr << "    cinch --help, or cinch COMMAND --help, says what is allowed\n";
    return static_cast<int>(cinch::ExitCode::usage);
  }
  try {
    return dispatch(commands, options);
  } catch (const cinch::Error& error) {
    print_error(error.what());
    return static_cast<int>(error.code);
  } catch (const std::bad_alloc&) {
    print_error("not enough memory");
    return static_cast<int>(cinch::ExitCode::input_output);
  } catch (const std::exception& error) {
    std::cerr << "internal error: " << error.what() << "\n";
    return static_cast<int>(cinch::ExitCode::internal);
  }
}

// What was printed may not have arrived: a full disk behind standard output. A run that failed or was stopped
// tells that first.
int code_with_output(int code) {
  std::cout.flush();
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return code;
  print_error("standard output: cannot write" +
              (errno != 0 ? ": " + std::generic_category().message(errno) : std::string()));
  const bool worked =
      code == static_cast<int>(cinch::ExitCode::done) || code == static_cast<int>(cinch::ExitCode::different);
  return worked ? static_cast<int>(cinch::ExitCode::input_output) : code;
}

}  // namespace

int main(int argc, char** argv) { return code_with_output(parse_and_dispatch(argc, argv)); }
