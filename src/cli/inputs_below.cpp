#include "cli/inputs_below.h"

#include <CLI/CLI.hpp>
#include <string>

#include "ifov/document.h"

namespace ifov::cli {

void add_inputs_below(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--inputs-below", [](const std::string& folder) { confine_inputs(folder); },
          "Open no input file but those in this folder and below it, whatever the document names and links lead to")
      ->type_name("DIR");
}

}  // namespace ifov::cli
