#pragma once

#include "cli/command.h"

namespace ifov::cli {

/// Commands about runs that are under way, were split up or are done.
Command add_status_command(CLI::App& app);
Command add_merge_command(CLI::App& app);
Command add_detect_command(CLI::App& app);
/// `ifov view`: products, runs and documents in the browser.
Command add_view_command(CLI::App& app);
/// `ifov sensor`: what follows of a document's sensor before a ray is cast.
Command add_sensor_command(CLI::App& app);
/// `ifov gases`: terms of gases from spectra line by line.
Command add_gases_command(CLI::App& app);
/// `ifov sensors`: instruments whose channels documents take by name.
Command add_sensors_command(CLI::App& app);

}  // namespace ifov::cli
