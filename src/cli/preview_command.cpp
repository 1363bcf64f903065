#include "cli/preview_command.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "cli/cancel_watchdog.h"
#include "cli/command.h"
#include "cli/inputs_below.h"
#include "cli/interrupt.h"
#include "cli/terminal/console.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal_picture.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/products.h"
#include "ifov/simulation.h"

namespace ifov::cli {
namespace {

constexpr int kMostColumns = 120;

int columns_of_output() {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return std::min(known ? static_cast<int>(size.ws_col) : 80, kMostColumns);
}

}  // namespace

ExitCode preview(const PreviewArguments& arguments) {
  CancelToken& cancel = cancel_on_interrupt();
  CancelWatchdog watchdog(cancel, "ifov: stopped on request; no picture was written");
  Console console(arguments.quiet, "");
  try {
    const Document document = arguments.input.read(arguments.document).for_preview(arguments.pixels);
    const Simulation simulation = Simulation::load(document, {.scene_cache = !arguments.no_cache,
                                                              .threads = arguments.threads,
                                                              .cancel = &cancel,
                                                              .progress = &console,
                                                              .log = &console});
    watchdog.over();
    if (arguments.strict) require_no_warnings(simulation.warnings().size());
    console.phase("preview");
    const Preview picture =
        simulation.preview({.seconds = arguments.seconds, .threads = arguments.threads, .cancel = &cancel});
    console.finish();
    const std::string path =
        arguments.output.empty()
            ? std::filesystem::path(arguments.document).replace_extension(".preview.png").string()
            : arguments.output;
    write_file(path, picture.png);
    if (!arguments.quiet) {
      if (const TerminalColours colours = terminal_colours(); colours != TerminalColours::none)
        std::fputs(terminal_picture(picture.width_px, picture.height_px, picture.pixels, columns_of_output(),
                                    colours)
                       .c_str(),
                   stdout);
      say(simulation.description());
      say(format("{}\n{}  (picture, PNG)\n", picture.statement, path));
    }
    return simulation.warnings().empty() ? ExitCode::ok : ExitCode::warned;
  } catch (const Cancelled&) {
    console.finish();
    std::fprintf(stderr, "ifov: stopped on request; no picture was written\n");
    return ExitCode::stopped;
  }
}

Command add_preview_command(CLI::App& app) {
  auto arguments = std::make_shared<PreviewArguments>();
  CLI::App* parser = app.add_subcommand("preview", "Make a first picture in a few seconds");
  parser->add_option("FILE", arguments->document, "The document (JSON)")->required();
  arguments->input.add_to(*parser);
  add_inputs_below(*parser);
  parser
      ->add_option("-o,--output", arguments->output,
                   "The picture (default: beside the document, NAME.preview.png)")
      ->type_name("PNG");
  parser->add_option("--seconds", arguments->seconds, "Time for paths")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  parser->add_option("--pixels", arguments->pixels, "Pixels along the longer side, at most")
      ->check(CLI::Range(16, 1600))
      ->capture_default_str();
  parser->add_option("-j,--threads", arguments->threads, "Threads; 0 takes all cores")
      ->check(CLI::Range(0, 4096));
  parser->add_flag("--strict", arguments->strict, "Warnings are errors: exit code 1, and no picture");
  parser->add_flag("--no-cache", arguments->no_cache,
                   "Read all files of the scene, and keep nothing of them beside the document");
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  parser->footer(
      "One path after another at each pixel of a small image, coarse first, in the channels of the picture alone;\n"
      "draws it in a terminal that has colours, and says of the scene what 'ifov check' says. No accuracy is\n"
      "promised. Exit codes: 0 all well; 6 warnings; others as 'ifov --help' says.\n\n"
      "Examples:\n"
      "  ifov preview scene.json\n"
      "  ifov preview scene.json --set sensor.camera.orthographic.view_zenith=\"50 deg\" --seconds 10");
  return {parser, [arguments] { return preview(*arguments); }};
}

}  // namespace ifov::cli
