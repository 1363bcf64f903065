#include "core/version.h"

namespace ifov {

std::string version() { return IFOV_VERSION; }

}  // namespace ifov
