#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "atmosphere/profile/profile.h"

namespace ifov::io {

/// A gas by its formula, in letters of any case.
std::optional<atmosphere::Gas> gas_of(std::string_view word);

/// "unknown gas 'HCl'; expected 'H2O', ...", with the nearest.
std::string unknown_gas(std::string_view word);

}  // namespace ifov::io
