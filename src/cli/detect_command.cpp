#include <CLI/CLI.hpp>

#include "cli/inputs_below.h"
#include "cli/interrupt.h"
#include "cli/run_commands.h"
#include "cli/terminal/say.h"
#include "core/format.h"
#include "ifov/detect.h"

namespace ifov::cli {
namespace {

struct DetectArguments {
  std::string run, document, output;
  std::uint64_t seed = 1;
  int count = 1, threads = 0;
  bool quiet = false;
};

ExitCode detect(const DetectArguments& arguments) {
  DetectOptions options;
  options.folder = arguments.output;
  options.first_seed = arguments.seed;
  options.realizations = arguments.count;
  options.threads = arguments.threads;
  options.cancel = &cancel_on_interrupt();
  if (!arguments.document.empty()) options.other = Document::read(arguments.document);
  const Detection detection = ifov::detect(arguments.run, options);
  if (arguments.quiet) return ExitCode::ok;
  for (const Detection::Channel& channel : detection.channels)
    say(channel.noise > 0.0 ? format("{:<16} noise {:.4g} W m-2 sr-1 um-1\n", channel.name, channel.noise)
                            : format("{:<16} tells no noise, and gets none\n", channel.name));
  for (const std::filesystem::path& cube : detection.cubes) say(cube.string() + "\n");
  return ExitCode::ok;
}

}  // namespace

Command add_detect_command(CLI::App& app) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App* parser =
      app.add_subcommand("detect", "Draw the sensor's noise on the radiance of a finished run");
  parser->add_option("RUN", arguments->run, "The run's folder, or its record (NAME_run.json)")->required();
  parser->add_option("--seed", arguments->seed, "Of the noise: the same seed gives the same noise")
      ->capture_default_str();
  parser->add_option("--count", arguments->count, "So many realizations, with rising seeds")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  parser->add_option("--document", arguments->document,
                     "A document whose channels tell the noise, in place of the run's own");
  parser->add_option("-o,--output", arguments->output, "Folder of the cubes, in place of the run's");
  parser->add_option("-j,--threads", arguments->threads, "Threads; 0: all cores")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  add_inputs_below(*parser);
  parser->footer(
      "Channels tell their noise by 'noise' (NEdL) or 'noise_temperature' (NEdT at 300 K). No ray is traced.\n\n"
      "Example:\n"
      "  ifov render scene.json\n"
      "  ifov detect scene.out --seed 7 --count 10");
  return {parser, [arguments] { return detect(*arguments); }};
}

}  // namespace ifov::cli
