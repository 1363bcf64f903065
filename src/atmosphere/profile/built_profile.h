#pragma once

#include <string>
#include <vector>

#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

struct ProfileDescription;

/// A profile from the ground to 100 km, and what had to be done to it, in words for the user.
struct BuiltProfile {
  Profile profile;
  std::vector<std::string> remarks;
};

/// InputError for an unknown model, levels that do not rise, values that cannot be, or a ground outside the
/// levels or at 6 km and above.
BuiltProfile build_profile(const ProfileDescription& description);

}  // namespace ifov::atmosphere
