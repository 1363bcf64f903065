#include <CLI/CLI.hpp>

#include "cli/run_commands.h"
#include "cli/run_summary.h"
#include "cli/terminal/console.h"
#include "ifov/runs.h"

namespace ifov::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> folders;
  std::string output;
  bool partial = false, quiet = false;
};

ExitCode merge(const MergeArguments& arguments) {
  Console console(arguments.quiet, "");
  MergeOptions options;
  options.output_folder = arguments.output;
  options.partial = arguments.partial;
  options.log = &console;
  const Outcome outcome = ifov::merge({arguments.folders.begin(), arguments.folders.end()}, options);
  if (!arguments.quiet) print_summary(outcome);
  return static_cast<ExitCode>(outcome.verdict);
}

}  // namespace

Command add_merge_command(CLI::App& app) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* parser = app.add_subcommand("merge", "Make the products of tiles that were rendered in shares");
  parser->add_option("FOLDER", arguments->folders, "The output folders of 'ifov render --tiles'")->required();
  parser->add_option("-o,--output", arguments->output, "Folder of the products")->required();
  parser->add_flag("--partial", arguments->partial,
                   "Make products although tiles are missing; their pixels hold no value");
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  parser->footer(
      "The products are the same, byte for byte, as those of one run. The folders stay as they are.\n\n"
      "Example:\n"
      "  ifov render scene.json --tiles 1/2\n"
      "  ifov render scene.json --tiles 2/2\n"
      "  ifov merge scene.out.1-of-2 scene.out.2-of-2 --output scene.out");
  return {parser, [arguments] { return merge(*arguments); }};
}

}  // namespace ifov::cli
