#include "scene/scene.h"

namespace ifov::scene {

ResolvedSurface Scene::resolve(const geometry::SurfacePoint& point) const {
  const Covering& covering = coverings[point.material];
  ResolvedSurface surface;
  const std::uint32_t index =
      covering.classes ? covering.classes->at(point.position_m.x, point.position_m.y) : std::uint16_t{0};
  surface.state = covering.states[index];
  surface.material = states[surface.state].material;
  if (!covering.temperatures.empty() && covering.temperatures[index])
    surface.mapped_temperature_k =
        covering.temperatures[index]->at_k(point.position_m.x, point.position_m.y);
  return surface;
}

}  // namespace ifov::scene
