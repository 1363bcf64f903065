#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "core/format.h"
#include "io/document/document.h"
#include "session/session.h"

namespace ifov::cli {
namespace {

struct RenderArguments {
  std::string document, output, log;
  int threads = 0;
  bool quiet = false, no_cache = false;
};

void print_summary(const session::RunSummary& summary) {
  std::string text;
  for (const session::ProductFile& file : summary.files)
    text += format("{}  ({})\n", file.path.string(), file.what);
  const Progress& totals = summary.totals;
  text += format(
      "{} pixels, {} rays in {} ({} rays/s)\n", totals.pixels_done,
      short_count(static_cast<double>(totals.rays)),
      totals.elapsed_s < 60.0 ? format("{:.2f} s", totals.elapsed_s) : short_duration(totals.elapsed_s),
      short_count(static_cast<double>(totals.rays) / std::max(totals.elapsed_s, 1e-9)));
  if (!summary.accuracy_statement.empty()) text += summary.accuracy_statement + "\n";
  std::fputs(text.c_str(), stdout);
}

ExitCode render(const RenderArguments& arguments) {
  CancelToken& cancel = cancel_on_interrupt();
  Console console(arguments.quiet, arguments.log);
  try {
    const io::Document document = io::read_document(arguments.document);
    const session::Session session = session::Session::load(document, &console,
                                                             {.scene_cache = !arguments.no_cache,
                                                              .threads = arguments.threads,
                                                              .cancel = &cancel,
                                                              .progress = &console});
    session::RunOptions options;
    options.threads = arguments.threads;
    options.output_folder = arguments.output;
    options.cancel = &cancel;
    options.progress = &console;
    options.log = &console;
    if (cancel.cancelled()) throw Cancelled();
    const session::RunSummary summary = session.render(options);
    console.finish();
    if (!arguments.quiet) print_summary(summary);
  } catch (const std::exception& error) {
    console.finish();
    console.info(format("ended: {}", error.what()));
    throw;
  }
  return ExitCode::ok;
}

}  // namespace

Command add_render_command(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* parser = app.add_subcommand("render", "Render a document to calibrated products");
  parser->add_option("FILE", arguments->document, "The document (JSON)")->required();
  parser->add_option("-o,--output", arguments->output,
                     "Folder of the products (default: as the document says)");
  parser
      ->add_option("-j,--threads", arguments->threads,
                   "Threads; 0 takes all cores. The result is the same for any number")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  parser->add_option("--log", arguments->log, "Write what happens to this file");
  parser->add_flag("--no-cache", arguments->no_cache,
                   "Read all files of the scene, and keep nothing of them beside the document");
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  parser->footer(
      "Writes the radiance (ENVI, GeoTIFF), its standard error, sample counts, material abundances,\n"
      "a picture, a report and run.json; names are listed at the end. Ctrl-C stops within a second\n"
      "and leaves no product that looks complete; a second Ctrl-C ends at once.\n\n"
      "Examples:\n"
      "  ifov render scene.json\n"
      "  ifov render scene.json --output /data/run7 --threads 8 --log run7.log");
  return {parser, [arguments] { return render(*arguments); }};
}

}  // namespace ifov::cli
