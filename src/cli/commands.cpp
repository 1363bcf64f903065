#include "cli/commands.h"

#include "cli/run_commands.h"

namespace ifov::cli {
namespace {

constexpr AddCommand kCommands[] = {
    add_render_command, add_check_command,       add_preview_command, add_atmosphere_command,
    add_info_command,   add_study_command,       add_make_command,    add_materials_command,
    add_brdf_command,   add_temperature_command, add_status_command,  add_merge_command,
    add_detect_command, add_view_command,        add_sensor_command,  add_sensors_command,
    add_schema_command, add_gases_command,
};

}  // namespace

std::span<const AddCommand> all_commands() { return kCommands; }

}  // namespace ifov::cli
