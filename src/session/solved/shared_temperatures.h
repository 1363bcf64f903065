#pragma once

#include <memory>
#include <span>
#include <string>

#include "scene/temperature_scope.h"

namespace ifov::session {

class Session;

/// The solved temperatures of sessions of one document at several times, asked together.
struct SharedTemperatures {
  std::unique_ptr<const scene::TemperaturesOfTimes> of;  ///< null: they cannot be
  std::string why_not;                                   ///< in words
};
/// Keeps references to the sessions' scenes.
SharedTemperatures share_temperatures(std::span<const Session* const> by_time);

}  // namespace ifov::session
