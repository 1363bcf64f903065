#pragma once

#include <string>
#include <vector>

namespace ifov::session {

struct Parts;

/// What is to be known of a sensor's optics, detector columns and filters, a line each.
std::vector<std::string> sensor_notes(const Parts& parts);

}  // namespace ifov::session
