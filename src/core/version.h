#pragma once

#include <string>

namespace ifov {

/// Version of the program, "0.1.0".
std::string version();

}  // namespace ifov
