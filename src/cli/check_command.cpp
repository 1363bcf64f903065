#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/command.h"
#include "cli/console.h"
#include "io/document/document.h"
#include "session/session.h"

namespace ifov::cli {

Command add_check_command(CLI::App& app) {
  auto file = std::make_shared<std::string>();
  auto quiet = std::make_shared<bool>(false);
  CLI::App* parser =
      app.add_subcommand("check", "Read a document and all files it names, and say what is wrong");
  parser->add_option("FILE", *file, "The document (JSON)")->required();
  parser->add_flag("-q,--quiet", *quiet, "Print nothing but errors");
  parser->footer(
      "Prints what was loaded: objects, triangles, materials, channels and the floors of the accuracy.\n"
      "An error names file, line and column and shows the line.\n\n"
      "Example:\n"
      "  ifov check scene.json && ifov render scene.json");
  return {parser, [file, quiet] {
            Console console(*quiet, "");
            const session::Session session = session::Session::load(io::read_document(*file), &console);
            std::string text = session.description();
            if (text.empty() || text.back() != '\n') text += '\n';
            if (!*quiet) std::fputs(text.c_str(), stdout);
            return ExitCode::ok;
          }};
}

}  // namespace ifov::cli
