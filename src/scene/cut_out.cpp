#include "scene/cut_out.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "materials/draped_map.h"
#include "materials/opacity_map.h"
#include "scene/scene.h"

namespace ifov::scene {

SurfaceCutOut::SurfaceCutOut(std::shared_ptr<const materials::ClassMap> classes,
                             std::vector<std::shared_ptr<const materials::OpacityMap>> holes)
    : classes_(std::move(classes)), holes_(std::move(holes)) {
  if (std::ranges::none_of(holes_, [](const auto& one) { return one != nullptr; }))
    throw InputError("a surface with holes needs an opacity map");
}

bool SurfaceCutOut::is_open(math::Point3 position_m, double u, double v) const {
  return is_open(materials::MapPosition{position_m.x, position_m.y, u, v});
}

bool SurfaceCutOut::is_open(const materials::MapPosition& position) const {
  const auto& holes = holes_[classes_ ? classes_->at(position) : std::uint16_t{0}];
  return holes && holes->is_open(position);
}

void SurfaceCutOut::add_maps(std::vector<const materials::NumberedMap*>& maps) const {
  for (const auto& holes : holes_)
    if (holes) maps.push_back(holes.get());
}

const materials::MapGrid& SurfaceCutOut::grid() const {
  return (*std::ranges::find_if(holes_, [](const auto& one) { return one != nullptr; }))->grid();
}

std::vector<std::shared_ptr<const geometry::CutOut>> cut_outs(const Scene& scene) {
  std::vector<std::shared_ptr<const geometry::CutOut>> all;
  bool any = false;
  for (const SurfaceAssignment& assignment : scene.assignments) {
    all.push_back(assignment.cut_out);
    any = any || assignment.cut_out != nullptr;
  }
  if (!any) all.clear();
  return all;
}

}  // namespace ifov::scene
