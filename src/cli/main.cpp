#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>
#include <vector>

#include "cli/commands.h"
#include "cli/faults.h"
#include "cli/ranks.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "core/machine_memory.h"
#include "core/names.h"
#include "core/version.h"

namespace ifov::cli {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  ifov check scene.json             what is in it, or what is wrong with it\n"
    "  ifov render scene.json            radiance, errors, a picture and a report\n"
    "  ifov info scene.out               what came out\n\n"
    "Exit codes: 0 done; 1 the command line or the input is wrong; 2 a file, the disk or memory fails;\n"
    "3 a bug in ifov; 4 a study's figure is not what it must be, or a time limit came first;\n"
    "5 done, but some pixels do not meet the accuracy; 6 done, with warnings (--strict: errors);\n"
    "130 stopped by Ctrl-C.";

int fail(ExitCode code, const std::string& message) {
  complain(message);
  return static_cast<int>(code);
}

/// Help and version are not errors; a misspelt command gets a suggestion.
int command_line_outcome(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
  }
  const std::string first = argc > 1 ? argv[1] : "";
  const bool is_command = std::find(commands.begin(), commands.end(), first) != commands.end();
  if (!first.empty() && first[0] != '-' && !is_command) {
    const std::string hint = did_you_mean(first, commands);
    return fail(ExitCode::input, format("ifov: there is no command '{}'{} Commands: {}", first,
                                        hint.empty() ? "." : hint, list_names(commands, "and")));
  }
  const std::string help = is_command ? format("ifov {} --help", first) : "ifov --help";
  return fail(ExitCode::input, format("ifov: {}\nSee '{}'.", error.what(), help));
}

int run(int argc, char** argv) {
  CLI::App app("Synthetic remote-sensing images with a stated accuracy.", "ifov");
  const std::string mpi = mpi_library();
  app.set_version_flag("--version",
                       format("ifov {}\n{}", version(), mpi.empty() ? "built without MPI" : mpi));
  app.footer(kFooter);
  app.require_subcommand(1);
  std::vector<Command> commands;
  for (const AddCommand add : all_commands()) commands.push_back(add(app));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return command_line_outcome(app, error, argc, argv);
  }
  for (const Command& command : commands) {
    if (command.parser->parsed()) return static_cast<int>(command.run());
  }
  return fail(ExitCode::bug, "ifov: a command was accepted that nothing carries out; please report this bug");
}

}  // namespace
}  // namespace ifov::cli

namespace {

int run_and_say(int argc, char** argv) {
  using namespace ifov;
  using cli::ExitCode;
  try {
    return cli::run(argc, argv);
  } catch (const InputError& error) {
    return cli::fail(ExitCode::input, error.what());
  } catch (const SystemError& error) {
    return cli::fail(ExitCode::environment, format("ifov: {}", error.what()));
  } catch (const Cancelled&) {
    return cli::fail(ExitCode::stopped,
                     "ifov: stopped on request; unfinished products carry the ending .part");
  } catch (const std::system_error& error) {
    return cli::fail(ExitCode::environment, format("ifov: {}", error.what()));
  } catch (const std::bad_alloc&) {
    return cli::fail(ExitCode::environment, format("ifov: {}", memory_ran_out()));
  } catch (const std::exception& error) {
    return cli::fail(ExitCode::bug, format("ifov: this is a bug, please report it: {}", error.what()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  // GDAL brings OpenBLAS, which nothing here uses: without threads it asks for no memory for them as it is loaded.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  ifov::cli::answer_faults();
  const int code = run_and_say(argc, argv);
  ifov::cli::leave_ranks();
  if (code == static_cast<int>(ifov::cli::ExitCode::environment)) {
    // Where memory is short a library's own thread (OpenBLAS's, by way of GDAL) asks for it for ever, and the library
    // waits for that thread as a process exits.
    std::fflush(nullptr);
    std::_Exit(code);
  }
  return code;
}
