#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/inputs_below.h"
#include "cli/interrupt.h"
#include "cli/terminal/console.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "core/names.h"
#include "studies/studies.h"

namespace ifov::cli {
namespace {

struct StudyArguments {
  std::string name, output, log, scene, reference;
  int trials = 1000, threads = 0;
  std::uint64_t seed = 1;
  bool quiet = false;
};

const studies::StudyEntry& study_named(const std::string& name) {
  if (const studies::StudyEntry* entry = studies::find_study(name)) return *entry;
  std::vector<std::string> names;
  for (const studies::StudyEntry& entry : studies::all_studies()) names.emplace_back(entry.name);
  throw InputError(format(
      "there is no study '{}'{} Studies: {}", name,
      [&] {
        const std::string hint = did_you_mean(name, names);
        return hint.empty() ? std::string(".") : hint;
      }(),
      list_names(names, "and")));
}

ExitCode study(const StudyArguments& arguments) {
  const studies::StudyEntry& entry = study_named(arguments.name);
  if (!arguments.scene.empty() && !entry.takes_scene)
    throw InputError(format("the study '{}' has scenes of its own: --scene does not go with it", entry.name));
  Console console(arguments.quiet, arguments.log);
  studies::StudyOptions options;
  options.output_folder = arguments.output.empty() ? format("study-{}", entry.name) : arguments.output;
  options.scene = arguments.scene;
  options.reference = arguments.reference;
  options.trials = arguments.trials;
  options.threads = arguments.threads;
  options.seed = arguments.seed;
  options.cancel = &cancel_on_interrupt();
  options.progress = &console;
  options.log = &console;
  const studies::StudyOutcome outcome = entry.run(options);
  console.finish();
  std::string text = outcome.table + "\n";
  for (const std::filesystem::path& file : outcome.files) text += format("{}\n", file.string());
  if (!arguments.quiet) say(text);
  return outcome.all_met ? ExitCode::ok : ExitCode::unmet;
}

}  // namespace

Command add_study_command(CLI::App& app) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* parser = app.add_subcommand("study", "Run a study and write its report");
  parser->add_option("NAME", arguments->name, "Which study")->required();
  parser->add_option("-o,--output", arguments->output, "Folder of the report (default: study-NAME)");
  parser->add_option(
      "--reference", arguments->reference,
      "Folder of reference data (atmosphere, sensor, temperature; default: the environment variable IFOV_TRUTH)");
  parser->add_option("--scene", arguments->scene,
                     "Document to study instead of the study's own scene (suburb)");
  parser->add_option("--trials", arguments->trials, "Random shifts of each scene; fewer give a quick look")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  parser->add_option("--seed", arguments->seed, "Seed of the shifts and of the renderings")
      ->capture_default_str();
  parser->add_option("-j,--threads", arguments->threads, "Threads; 0 takes all cores")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  add_inputs_below(*parser);
  parser->add_option("--log", arguments->log, "Write what happens to this file");
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  std::string footer = "Studies:\n";
  for (const studies::StudyEntry& entry : studies::all_studies()) {
    footer += format("  {:<11} {}\n", entry.name, entry.summary);
  }
  parser->footer(
      footer +
      "\nWrites report.html and figures.json, and prints the figures. The exit code is 4 where a figure is "
      "not what it must be.\n\n"
      "Example:\n"
      "  ifov study thermal --trials 100 --output /tmp/thermal");
  return {parser, [arguments] { return study(*arguments); }};
}

}  // namespace ifov::cli
