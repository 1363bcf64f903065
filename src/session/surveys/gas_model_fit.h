#pragma once

#include <filesystem>

#include "ifov/gas_model.h"

namespace ifov::session {

/// As ifov::make_gas_model.
GasModelOutcome make_gas_model(const GasModelQuestion& question, const std::filesystem::path& to);

}  // namespace ifov::session
