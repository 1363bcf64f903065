#include "session/assembly/shared/scene_maps.h"

#include <optional>
#include <vector>

#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

void MapsOfScene::to_scene(const io::DocumentName& crs, std::span<math::Point3> places) const {
  const MapFrame scene(sources_, origin_);
  math::Vec3 offset_m = scene.offset_m();
  offset_m.z = origin_.height_m;
  const auto take_over = [&] {
    const io::MapReference to(map_system(origin_));
    const io::MapReference from(crs.name);
    if (!from.is_projected())
      throw InputError(format(
          "'{}' is no map projection, whose coordinates are lengths; longitudes and latitudes are of the frame "
          "\"geodetic\"",
          from.name()));
    if (from.same_as(to)) return;
    std::vector<io::MapPoint> points;
    for (const math::Point3& place : places)
      points.push_back({place.x / from.metres_per_unit(), place.y / from.metres_per_unit()});
    io::MapTransform(from, to).apply(points);
    for (std::size_t k = 0; k < places.size(); ++k) places[k].x = points[k].x, places[k].y = points[k].y;
  };
  if (!crs.name.empty()) with_position(sources_, crs.position, take_over);
  for (math::Point3& place : places) place = place - offset_m;
}

}  // namespace ifov::session
