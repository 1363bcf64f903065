#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/document_arguments.h"
#include "cli/inputs_below.h"
#include "cli/interrupt.h"
#include "cli/run_commands.h"
#include "cli/terminal/say.h"
#include "core/format.h"
#include "viewer/view_server.h"

namespace ifov::cli {
namespace {

struct ViewArguments {
  std::vector<std::string> what;
  DocumentArguments input;
  std::string listen, token_file;
  int port = 0;
  bool no_browser = false;
};

ExitCode view(const ViewArguments& arguments) {
  CancelToken& cancel = cancel_on_interrupt();
  viewer::ViewServer server({.what = {arguments.what.begin(), arguments.what.end()},
                             .set = arguments.input.set,
                             .address = arguments.listen,
                             .port = arguments.port,
                             .token_file = arguments.token_file});
  say(format("{}\n", server.url()));
  if (!arguments.no_browser && !server.open_browser())
    say("no browser was started here: open this address in one\n");
  say("Ctrl-C ends it\n");
  std::fflush(stdout);
  server.serve(cancel);
  return ExitCode::ok;
}

}  // namespace

Command add_view_command(CLI::App& app) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* parser = app.add_subcommand(
      "view",
      "Look at products, at a run at work or at a document in the browser: image, spectra, scatter plots, scene");
  parser
      ->add_option(
          "WHAT", arguments->what,
          "A folder of products, of a run at work or of a series of times, two folders to compare, or a document (JSON)")
      ->required()
      ->expected(1, 2);
  arguments->input.add_to(*parser);
  add_inputs_below(*parser);
  parser->add_flag("--no-browser", arguments->no_browser, "Print the address, and start no browser");
  parser->add_option("--port", arguments->port, "Port to listen at; 0 takes any that is free")
      ->check(CLI::Range(0, 65535));
  parser
      ->add_option("--listen", arguments->listen,
                   "Address to listen at; one that other machines reach needs --token-file")
      ->type_name("ADDRESS");
  parser
      ->add_option(
          "--token-file", arguments->token_file,
          "File of the user's own (mode 600) with the token that the page asks for; by default a new one")
      ->type_name("FILE");
  parser->footer(
      "Serves a page to this machine alone, at a random port, to who has the token in the address. What is sent is\n"
      "not encrypted: on another machine use a tunnel (ssh -L) rather than --listen.\n\n"
      "Examples:\n"
      "  ifov view scene.out\n"
      "  ifov view first.out second.out\n"
      "  ifov view scene.json");
  return {parser, [arguments] { return view(*arguments); }};
}

}  // namespace ifov::cli
