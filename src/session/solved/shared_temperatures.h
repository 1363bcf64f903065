#pragma once

#include <memory>
#include <span>
#include <string>

#include "scene/temperature_scope.h"

namespace ifov::session {

struct Parts;

/// The solved temperatures of one document, loaded at several times, to be asked together.
struct SharedTemperatures {
  std::unique_ptr<const scene::TemperaturesOfTimes> of;  ///< null: they cannot be
  std::string why_not;                                   ///< in words
};
/// Keeps references to the scenes.
SharedTemperatures share_temperatures(std::span<const Parts* const> by_time);

}  // namespace ifov::session
