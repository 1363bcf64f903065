#include "scene/cut_out.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "materials/draped_map.h"
#include "materials/opacity_map.h"

namespace ifov::scene {

SurfaceCutOut::SurfaceCutOut(std::shared_ptr<const materials::ClassMap> classes,
                             std::vector<std::shared_ptr<const materials::OpacityMap>> holes)
    : classes_(std::move(classes)), holes_(std::move(holes)) {
  if (std::ranges::none_of(holes_, [](const auto& one) { return one != nullptr; }))
    throw InputError("a surface with holes needs an opacity map");
}

bool SurfaceCutOut::is_open(math::Point3 position_m, geometry::Uv uv) const {
  return is_open(materials::MapPosition{position_m.x, position_m.y, uv.u, uv.v});
}

bool SurfaceCutOut::is_open(const materials::MapPosition& position) const {
  const auto& holes = holes_[classes_ ? classes_->at(position) : std::uint16_t{0}];
  return holes && holes->is_open(position);
}

const materials::MapGrid& SurfaceCutOut::grid() const {
  return (*std::ranges::find_if(holes_, [](const auto& one) { return one != nullptr; }))->grid();
}

}  // namespace ifov::scene
