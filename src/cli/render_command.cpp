#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "cli/cancel_watchdog.h"
#include "cli/command.h"
#include "cli/document_arguments.h"
#include "cli/duration.h"
#include "cli/inputs_below.h"
#include "cli/interrupt.h"
#include "cli/preview_command.h"
#include "cli/ranks.h"
#include "cli/run_summary.h"
#include "cli/terminal/console.h"
#include "cli/terminal/progress_line.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/instruments.h"
#include "ifov/runs.h"
#include "ifov/series.h"
#include "ifov/simulation.h"

namespace ifov::cli {
namespace {

/// The run sets aside what products usually take; those that come a little later are still waited for.
constexpr std::chrono::milliseconds kLastProducts(200);

struct RenderArguments {
  std::string document, output, log, tiles, time_limit, times;
  DocumentArguments input;
  int threads = 0;
  bool quiet = false, no_cache = false, resume = false, restart = false, no_state = false, dry_run = false;
  bool keep = false, refine = false, anyway = false, strict = false, quick = false;
};

void print_forecast(const Forecast& forecast, double loading_s) {
  const auto size = [](std::uint64_t bytes) {
    return format("{}B", short_count(static_cast<double>(bytes)));
  };
  const auto time = [](double seconds) {
    return seconds < 60.0 ? format("{:.2f} s", seconds) : short_duration(seconds);
  };
  std::string text;
  if (forecast.probes > 0) {
    text += format("rays       {}\n", short_count(forecast.rays));
    text += format("time       {}, give or take {:.0f} %; {} of processor time\n", time(forecast.elapsed_s),
                   200.0 * forecast.uncertainty, time(forecast.processor_s));
    text += format("loading    {} before that, as just now\n", time(loading_s));
  }
  text += format("memory     {}\n", size(forecast.memory_bytes));
  text += format("disk       {} while it works, {} of products\n", size(forecast.disk_bytes),
                 size(forecast.product_bytes));
  text += forecast.probes > 0 ? format("probed     {} pieces, {:.3g} % of the image, in {:.1f} s\n",
                                       forecast.probes, 100.0 * forecast.probed_share, forecast.probing_s)
                              : "probed     nothing: there is too little memory\n";
  for (const std::string& shortage : forecast.shortages) text += format("it will not do: {}\n", shortage);
  say(text);
}

/// "17/64".
TileShare read_share(const std::string& text) {
  TileShare share;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%9d/%9d%c", &share.number, &share.count, &rest) != 2 || share.number < 1 ||
      share.count < share.number)
    throw InputError(format("--tiles '{}': expected which share of how many, such as 1/64 to 64/64", text));
  return share;
}

std::optional<std::chrono::steady_clock::time_point> deadline_of(
    const RenderArguments& arguments, std::chrono::steady_clock::time_point begin) {
  if (arguments.time_limit.empty()) return std::nullopt;
  return begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                     read_duration(arguments.time_limit, "--time-limit"));
}

/// --times gives the document its times.
void require_no_time(const std::vector<std::string>& set) {
  for (const std::string& one : set)
    if (one.starts_with("time="))
      throw InputError(format("--set {}: --times gives the document its times; leave one of them out", one));
}

RenderOptions options_of(const RenderArguments& arguments, CancelToken& cancel, Console& console) {
  RenderOptions options;
  options.folder = arguments.output;
  options.threads = arguments.threads;
  if (!arguments.tiles.empty()) options.share = read_share(arguments.tiles);
  options.cancel = &cancel;
  options.progress = &console;
  options.log = &console;
  options.keep_tiles = !arguments.no_state;
  options.keep = arguments.keep;
  options.refine = arguments.refine;
  options.anyway = arguments.anyway;
  options.start = arguments.resume    ? RunStart::resume
                  : arguments.restart ? RunStart::restart
                                      : RunStart::fresh;
  return options;
}

ExitCode render(const RenderArguments& arguments) {
  if (arguments.quick)
    return preview({.document = arguments.document,
                    .output = {},
                    .input = arguments.input,
                    .threads = arguments.threads,
                    .quiet = arguments.quiet,
                    .no_cache = arguments.no_cache,
                    .strict = arguments.strict});
  const auto begin = std::chrono::steady_clock::now();
  CancelToken& cancel = cancel_on_interrupt();
  Ranks* const ranks = join_ranks();
  if (ranks != nullptr && !ranks->leads()) {
    ranks->work(arguments.document, {.set = arguments.input.set,
                                     .threads = arguments.threads,
                                     .scene_cache = !arguments.no_cache,
                                     .cancel = &cancel});
    return ExitCode::ok;
  }
  std::optional<StopNotice> notice;
  if (ranks != nullptr) {
    if (arguments.no_state)
      throw InputError(
          "--no-state: several ranks put their tiles together in the run's folder; leave it out, or start one");
    notice.emplace(
        cancel,
        "ifov: stopped (Ctrl-C, or a rank ended: mpirun says which); unfinished products carry the ending "
        ".part, and --resume goes on with what is finished");
  }
  std::optional<CancelWatchdog> watchdog;  // mpirun ends ranks by itself
  if (ranks == nullptr)
    watchdog.emplace(cancel,
                     format("ifov: stopped on request; unfinished products carry the ending .part{}",
                            arguments.no_state ? "" : ", and --resume goes on with what is finished"));
  const std::optional<std::chrono::steady_clock::time_point> deadline = deadline_of(arguments, begin);
  if (watchdog && deadline)
    watchdog->limit(*deadline, "ifov: the time limit came before the scene was loaded; nothing is rendered");
  Console console(arguments.quiet, arguments.log);
  try {
    if (!arguments.times.empty()) {
      require_no_time(arguments.input.set);
      SeriesOptions options{{.scene_cache = !arguments.no_cache,
                             .threads = arguments.threads,
                             .cancel = &cancel,
                             .ranks = ranks},
                            options_of(arguments, cancel, console),
                            arguments.strict};
      options.render.deadline = deadline;
      if (watchdog) watchdog->over();
      const SeriesOutcome outcome =
          render_series(arguments.input.read(arguments.document), arguments.times, options);
      console.finish();
      if (!arguments.quiet) print_summary(outcome);
      return static_cast<ExitCode>(outcome.verdict);
    }
    const bool takes_all = ranks == nullptr && arguments.tiles.empty() && !arguments.dry_run;
    if (takes_all && !instruments_of(arguments.document, arguments.input.set).empty()) {
      InstrumentsOptions options{{.scene_cache = !arguments.no_cache,
                                  .threads = arguments.threads,
                                  .cancel = &cancel,
                                  .progress = &console,
                                  .log = &console},
                                 options_of(arguments, cancel, console),
                                 arguments.strict};
      options.render.deadline = deadline;
      if (watchdog) watchdog->over();
      const InstrumentsOutcome outcome = render_instruments(arguments.document, arguments.input.set, options);
      console.finish();
      if (!arguments.quiet) print_summary(outcome);
      return static_cast<ExitCode>(outcome.verdict);
    }
    const Document document = arguments.input.read(arguments.document);
    const Simulation simulation = Simulation::load(document, {.scene_cache = !arguments.no_cache,
                                                              .threads = arguments.threads,
                                                              .cancel = &cancel,
                                                              .progress = &console,
                                                              .log = &console,
                                                              .ranks = ranks});
    if (arguments.strict) require_no_warnings(simulation.warnings().size());
    RenderOptions options = options_of(arguments, cancel, console);
    options.deadline = deadline;
    options.ranks = ranks;
    if (watchdog) watchdog->over();
    if (watchdog && deadline && !arguments.dry_run)
      watchdog->limit(
          *deadline + kLastProducts,
          format("ifov: the time limit came before the products were whole; unfinished ones carry the ending "
                 ".part{}",
                 arguments.no_state ? "" : ", and --resume goes on with what is finished"));
    if (cancel.cancelled()) throw Cancelled();
    if (arguments.dry_run) {
      const std::chrono::duration<double> loading = std::chrono::steady_clock::now() - begin;
      const Forecast forecast = simulation.forecast(options);
      console.finish();
      print_forecast(forecast, loading.count());
      return forecast.shortages.empty() ? ExitCode::ok : ExitCode::environment;
    }
    const Outcome outcome = simulation.render(options);
    console.finish();
    if (!arguments.quiet) print_summary(outcome);
    return static_cast<ExitCode>(outcome.verdict);
  } catch (const Cancelled& stop) {
    console.finish();
    console.info(format("ended: {}", stop.what()));
    notice.reset();
    if (ranks == nullptr || !cancel.cancelled())
      complain(format("ifov: {}; unfinished products carry the ending .part{}", stop.what(),
                      arguments.no_state ? "" : ", and --resume goes on with what is finished"));
    return ExitCode::stopped;
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
  arguments->input.add_to(*parser);
  parser->add_option("-o,--output", arguments->output,
                     "Folder of the products (default: as the document says)");
  parser
      ->add_option("-j,--threads", arguments->threads,
                   "Threads; 0 takes all cores. The result is the same for any number")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  CLI::Option* times =
      parser
          ->add_option(
              "--times", arguments->times,
              "Render the document at several times, each into a folder of its own: the first, a step "
              "and how many, such as 2025-06-20T00:00Z/PT15M/96; with an animation and crossovers")
          ->type_name("START/STEP/COUNT");
  CLI::Option* resume =
      parser->add_flag("--resume", arguments->resume,
                       "Go on with the run in the output folder that was stopped; the products are the "
                       "same, byte for byte. Where there is none, begin");
  CLI::Option* restart =
      parser->add_flag("--restart", arguments->restart,
                       "Throw away what an unfinished run left in the output folder, and begin");
  CLI::Option* keep =
      parser->add_flag("--keep", arguments->keep, "Keep, beside the products, what --refine can go on from");
  CLI::Option* refine =
      parser->add_flag("--refine", arguments->refine,
                       "Take the kept run in the output folder to the tighter accuracy that the document "
                       "asks for now; pays only for the difference");
  parser
      ->add_flag("--no-state", arguments->no_state,
                 "Do not keep finished tiles: a run that is stopped cannot go on")
      ->excludes(resume)
      ->excludes(restart)
      ->excludes(keep)
      ->excludes(refine);
  resume->excludes(restart);
  parser->add_option(
      "--time-limit", arguments->time_limit,
      "Be done within this time (90s, 10min, 1.5h), products and all; pixels that were not reached hold "
      "no value, and --resume goes on with them");
  parser->add_flag("--anyway", arguments->anyway,
                   "Begin also where memory or disk will not do, by what is known before the first ray");
  parser->add_flag("--strict", arguments->strict,
                   "Render nothing where loading gives warnings; each is an error then");
  parser
      ->add_flag("--quick", arguments->quick,
                 "A first picture in a few seconds instead: the same as 'ifov preview'")
      ->excludes(resume)
      ->excludes(restart)
      ->excludes(keep)
      ->excludes(refine)
      ->excludes(times);
  parser
      ->add_flag("--dry-run", arguments->dry_run,
                 "Foretell rays, time, memory and disk from a few pieces of the image, and render nothing")
      ->excludes(times);
  parser
      ->add_option("--tiles", arguments->tiles,
                   "Render one share of the tiles, such as 17/64, for 'ifov merge'; makes no products")
      ->excludes(keep)
      ->excludes(refine)
      ->excludes(times);
  times->excludes(keep)->excludes(refine);
  parser->add_option("--log", arguments->log, "Write what happens to this file");
  add_inputs_below(*parser);
  parser->add_flag("--no-cache", arguments->no_cache,
                   "Read all files of the scene, and keep nothing of them beside the document");
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  parser->footer(
      "Writes the radiance (ENVI, GeoTIFF), its standard error, sample counts, material abundances,\n"
      "a picture, a report and run.json; names are listed at the end. Ctrl-C stops within a second\n"
      "and leaves no product that looks complete; a second Ctrl-C ends at once. Finished tiles are\n"
      "kept in the output folder, in run.part, until the products are whole.\n\n"
      "Examples:\n"
      "  ifov render scene.json\n"
      "  ifov render scene.json --resume\n"
      "  ifov render scene.json --output /data/run7 --threads 8 --log run7.log\n"
      "  ifov render scene.json --times 2025-06-20T00:00Z/PT15M/96\n\n"
      "Exit codes: 0 done and all well; 5 done, some pixels do not meet the accuracy; 6 done, with\n"
      "warnings; 4 the time limit came first; others as 'ifov --help' says.");
  return {parser, [arguments] { return render(*arguments); }};
}

}  // namespace ifov::cli
