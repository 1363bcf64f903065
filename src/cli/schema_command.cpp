#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/command.h"
#include "ifov/document.h"

namespace ifov::cli {

Command add_schema_command(CLI::App& app) {
  auto markdown = std::make_shared<bool>(false);
  CLI::App* parser = app.add_subcommand("schema", "Print the JSON Schema of documents, for editors");
  parser->add_flag("--markdown", *markdown, "The reference page instead")->group("");
  parser->footer(
      "Editors complete and check documents by it. Save it, and name it in the document or in the\n"
      "editor's settings (in Visual Studio Code: \"json.schemas\"):\n\n"
      "  ifov schema > ifov.schema.json\n"
      "  { \"$schema\": \"./ifov.schema.json\", \"ifov\": 1, ... }");
  return {parser, [markdown] {
            std::fputs((*markdown ? document_reference() : document_schema()).c_str(), stdout);
            return ExitCode::ok;
          }};
}

}  // namespace ifov::cli
