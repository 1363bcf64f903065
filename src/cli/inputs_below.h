#pragma once

namespace CLI {
class App;
}

namespace ifov::cli {

/// Adds --inputs-below to a command that reads files which others may have written.
void add_inputs_below(CLI::App& command);

}  // namespace ifov::cli
