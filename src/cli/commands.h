#pragma once

#include <span>

#include "cli/command.h"

namespace ifov::cli {

/// Adds one subcommand with its options and help.
using AddCommand = Command (*)(CLI::App& app);

/// All commands, in the order of the help page.
std::span<const AddCommand> all_commands();

}  // namespace ifov::cli
