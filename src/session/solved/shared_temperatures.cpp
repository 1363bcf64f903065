#include "session/solved/shared_temperatures.h"

#include <vector>

#include "exposure/shared_surfaces.h"
#include "session/loaded/parts.h"

namespace ifov::session {

std::unique_ptr<const scene::TemperaturesOfTimes> share_temperatures(std::span<const Parts* const> by_time) {
  std::vector<const scene::Scene*> scenes;
  for (const Parts* parts : by_time) scenes.push_back(&parts->scene);
  return exposure::share_surfaces(scenes);
}

}  // namespace ifov::session
