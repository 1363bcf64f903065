#pragma once

#include <string>

#include "ifov/api.h"

namespace ifov {

/// Version of ifov, "0.1.0".
IFOV_API std::string version();

}  // namespace ifov
