#include <CLI/CLI.hpp>

#include "cli/document_arguments.h"
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
  DocumentArguments input;
  std::vector<std::string> after;
  std::vector<DetectedQuantity> quantities = {DetectedQuantity::radiance};
  std::uint64_t seed = 1;
  int count = 1, threads = 0;
  bool mosaic = false, quiet = false;
};

ExitCode detect(const DetectArguments& arguments) {
  DetectOptions options;
  options.folder = arguments.output;
  options.first_seed = arguments.seed;
  options.realizations = arguments.count;
  options.threads = arguments.threads;
  options.cancel = &cancel_on_interrupt();
  options.quantities = arguments.quantities;
  options.mosaic = arguments.mosaic;
  options.after.assign(arguments.after.begin(), arguments.after.end());
  if (arguments.document.empty())
    options.set = arguments.input.set;
  else
    options.other = arguments.input.read(arguments.document);
  const Detection detection = ifov::detect(arguments.run, options);
  if (arguments.quiet) return ExitCode::ok;
  for (const Detection::Channel& channel : detection.channels) {
    std::string text = channel.noise > 0.0
                           ? format("{:<16} noise {:.4g} W m-2 sr-1 um-1", channel.name, channel.noise)
                           : format("{:<16} tells no noise, and gets none", channel.name);
    if (channel.has_detector) text += " at the detector's reference";
    if (channel.saturated > 0.0)
      text += format("; {:.3g} % of pixels are saturated", 100.0 * channel.saturated);
    say(text + "\n");
  }
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
  arguments->input.add_to(*parser);
  parser
      ->add_option(
          "--quantity", arguments->quantities,
          "What is written: radiance, electrons, counts, kelvins, toa_reflectance, or several with commas between them")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(std::vector<std::pair<std::string, DetectedQuantity>>{
          {"radiance", DetectedQuantity::radiance},
          {"electrons", DetectedQuantity::electrons},
          {"counts", DetectedQuantity::counts},
          {"kelvins", DetectedQuantity::kelvins},
          {"toa_reflectance", DetectedQuantity::toa_reflectance}}))
      ->default_str("radiance");
  parser->add_option(
      "--after", arguments->after,
      "Of a frame camera whose detector has a lag or a time constant: runs of the frames before, the last one first");
  parser->add_flag("--mosaic", arguments->mosaic,
                   "Of a sensor with a mosaic: each element through its own filter alone, as one band");
  parser->add_option("-o,--output", arguments->output, "Folder of the cubes, in place of the run's");
  parser->add_option("-j,--threads", arguments->threads, "Threads; 0: all cores")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  add_inputs_below(*parser);
  parser->footer(
      "Noise follows from the sensor's 'detector', or is stated by channels: 'noise' (NEdL), 'noise_temperature'\n"
      "(NEdT at 300 K), 'snr'. No ray is traced.\n\n"
      "Examples:\n"
      "  ifov render scene.json\n"
      "  ifov detect scene.out --seed 7 --count 10\n"
      "  ifov detect scene.out --quantity counts,radiance --set sensor.detector.integration_time=\"2 ms\"");
  return {parser, [arguments] { return detect(*arguments); }};
}

}  // namespace ifov::cli
