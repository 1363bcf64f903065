#pragma once

#include <optional>
#include <string>

#include "io/quantities/acquisition.h"

namespace ifov::session {

struct Parts;

/// Latitude and longitude of a place on a map; nothing where its system (well-known text) is unknown or ends before.
std::optional<io::Acquisition::Position> geographic_position(const std::string& map_system,
                                                             math::Point3 on_map_m);

/// What a run's products say of when, where and in which light their image was taken.
io::Acquisition assemble_acquisition(const Parts& parts);

}  // namespace ifov::session
