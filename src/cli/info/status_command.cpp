#include <CLI/CLI.hpp>

#include "cli/run_commands.h"
#include "cli/terminal/say.h"
#include "ifov/runs.h"

namespace ifov::cli {

Command add_status_command(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  CLI::App* parser =
      app.add_subcommand("status", "Say how far a run is: tiles done, accuracy reached, what is left");
  parser->add_option("FOLDER", *folder, "The output folder of the run")->required();
  parser->footer(
      "May be asked while the run is at work.\n\n"
      "Example:\n"
      "  ifov status scene.out");
  return {parser, [folder] {
            say(run_status(*folder).text);
            return ExitCode::ok;
          }};
}

}  // namespace ifov::cli
