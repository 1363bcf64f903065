#include "session/solved/shared_temperatures.h"

#include <vector>

#include "exposure/surfaces_of_times.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/series/series_renderer.h"
#include "session/loaded/parts.h"

namespace ifov::session {

SharedTemperatures share_temperatures(std::span<const Parts* const> by_time) {
  SharedTemperatures shared;
  if (by_time.size() < 2) return {nullptr, "there is one"};
  if (by_time.front()->document.platform) return {nullptr, "the sensor moves"};
  std::vector<render::RenderJob> jobs;
  std::vector<const render::RenderJob*> all;
  std::vector<const scene::Scene*> scenes;
  jobs.reserve(by_time.size());
  for (const Parts* parts : by_time) {
    all.push_back(&jobs.emplace_back(parts->job()));
    scenes.push_back(&parts->scene);
  }
  shared.why_not = render::cannot_share_paths(all);
  if (!shared.why_not.empty()) return shared;
  shared.of = exposure::SurfacesOfTimes::of(scenes);
  if (shared.of == nullptr)
    shared.why_not =
        "no temperature is solved, something came or went, or their steps do not fall on each other";
  return shared;
}

}  // namespace ifov::session
