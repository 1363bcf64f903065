#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/document_arguments.h"
#include "cli/inputs_below.h"
#include "cli/terminal/console.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/instruments.h"
#include "ifov/simulation.h"

namespace ifov::cli {
namespace {

struct CheckArguments {
  std::vector<std::string> files;
  DocumentArguments input;
  bool quiet = false, no_cache = false, strict = false;
};

std::string description_of(const CheckArguments& arguments, const Document& document, Console& console,
                           std::size_t& warnings) {
  const Simulation simulation =
      Simulation::load(document, {.scene_cache = !arguments.no_cache, .progress = &console, .log = &console});
  std::string text = simulation.description();
  warnings += simulation.warnings().size();
  console.finish();
  if (text.empty() || text.back() != '\n') text += '\n';
  return text;
}

/// All files are looked at, whatever is wrong with the first of them.
ExitCode check(const CheckArguments& arguments) {
  Console console(arguments.quiet, "");
  std::size_t warnings = 0;         // of the scenes
  ExitCode outcome = ExitCode::ok;  // the first of the worst
  const auto note = [&](ExitCode found) {
    if (outcome == ExitCode::ok || outcome == ExitCode::warned || found == ExitCode::environment)
      outcome = found;
  };
  for (const std::string& file : arguments.files) {
    try {
      std::string text = arguments.files.size() > 1 ? format("{}:\n", file) : std::string();
      const std::vector<std::string> instruments = instruments_of(file, arguments.input.set);
      for (const std::string& name : instruments)
        text += format("instrument {}:\n{}", name,
                       description_of(arguments, arguments.input.read(file, name), console, warnings));
      if (instruments.empty())
        text += description_of(arguments, arguments.input.read(file), console, warnings);
      if (!arguments.quiet) say(text);
    } catch (const InputError& error) {
      complain(error.what());
      note(ExitCode::input);
    } catch (const SystemError& error) {
      complain(format("ifov: {}", error.what()));
      note(ExitCode::environment);
    }
  }
  if (warnings > 0 && outcome == ExitCode::ok) return arguments.strict ? ExitCode::input : ExitCode::warned;
  return outcome;
}

}  // namespace

Command add_check_command(CLI::App& app) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* parser =
      app.add_subcommand("check", "Read documents and all files they name, and say what is wrong");
  parser->add_option("FILE", arguments->files, "The document (JSON), or several")->required();
  arguments->input.add_to(*parser);
  add_inputs_below(*parser);
  parser->add_flag("--no-cache", arguments->no_cache,
                   "Read all files of the scene, and keep nothing of them beside the document");
  parser->add_flag("--strict", arguments->strict, "Warnings are errors: exit code 1");
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  parser->footer(
      "Prints what was loaded and where it is: bounds of the scene, what the camera sees, the Sun, light and\n"
      "radiance by channel from some thousand rays, the floors of the accuracy. Warns of what is most likely\n"
      "not meant. An error names file, line and column and shows the line.\n"
      "Exit codes: 0 all well; 1 an error; 2 a file cannot be read; 6 warnings.\n\n"
      "Examples:\n"
      "  ifov check scene.json && ifov render scene.json\n"
      "  ifov check --quiet scenes/*.json");
  return {parser, [arguments] { return check(*arguments); }};
}

}  // namespace ifov::cli
