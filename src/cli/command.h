#pragma once

#include <functional>
#include <string>

#include "cli/exit_code.h"

namespace CLI {
class App;
}

namespace ifov::cli {

/// A subcommand: what the command line parser knows it by, and what it does. `run` throws InputError,
/// SystemError and Cancelled.
struct Command {
  CLI::App* parser = nullptr;
  std::function<ExitCode()> run;
};

/// Each adds one subcommand with its options and help.
Command add_render_command(CLI::App& app);
Command add_preview_command(CLI::App& app);
Command add_atmosphere_command(CLI::App& app);
Command add_check_command(CLI::App& app);
Command add_info_command(CLI::App& app);
Command add_study_command(CLI::App& app);
Command add_materials_command(CLI::App& app);
Command add_brdf_command(CLI::App& app);
Command add_temperature_command(CLI::App& app);
Command add_make_command(CLI::App& app);
Command add_schema_command(CLI::App& app);

}  // namespace ifov::cli
