#include "cli/inputs_below.h"

#include <CLI/CLI.hpp>
#include <string>

#include "ifov/document.h"

namespace ifov::cli {

namespace {

/// All commands work in this thread, until the program ends.
void confine_inputs(const std::string& folder) {
  static const InputsBelow inputs(folder);
  static_cast<void>(inputs);
}

}  // namespace

void add_inputs_below(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--inputs-below", confine_inputs,
          "Open no input file but those in this folder and below it, whatever the document names and links lead to")
      ->type_name("DIR");
}

}  // namespace ifov::cli
