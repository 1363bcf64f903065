#include "session/assembly/shared/map_frame.h"

#include <cmath>
#include <numbers>

#include "session/assembly/shared/with_position.h"

namespace ifov::session {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

}  // namespace

MapFrame::MapFrame(const io::DocumentSources& sources, const io::OriginDocument& origin)
    : document_offset_m_(origin.offset_m), offset_m_(origin.offset_m) {
  if (origin.crs.empty()) return;
  with_position(sources, origin.crs_position, [&] {
    reference_.emplace(origin.crs);
    if (!reference_->is_projected() || reference_->metres_per_unit() != 1.0)
      throw InputError(format("the scene's coordinates are metres; '{}' is not a map projection in metres",
                              reference_->name()));
    if (origin.has_map_offset) return;
    const io::MapTransform project(io::MapReference("EPSG:4326"), *reference_);
    const io::MapPoint position =
        project({origin.geographic->longitude_rad * kDegrees, origin.geographic->latitude_rad * kDegrees});
    offset_m_ = {position.x, position.y, origin.height_m};
  });
}

std::string map_system(const io::OriginDocument& origin) {
  if (!origin.crs.empty()) return io::MapReference(origin.crs).wkt();
  if (!origin.geographic) return "Arbitrary";
  return io::MapReference::around(origin.geographic->latitude_rad * kDegrees,
                                  origin.geographic->longitude_rad * kDegrees,
                                  {origin.offset_m.x, origin.offset_m.y})
      .wkt();
}

std::unique_ptr<io::MapTransform> MapFrame::transform_from(const std::string& projection,
                                                           const std::string& raster) const {
  if (projection.empty()) return nullptr;
  const io::MapReference from(projection);
  if (reference_) {
    if (from.same_as(*reference_)) return nullptr;
    return std::make_unique<io::MapTransform>(from, *reference_);
  }
  if (from.is_geographic() || (from.is_projected() && from.metres_per_unit() != 1.0))
    throw InputError(
        format("'{}' is in '{}', whose coordinates are not metres; give the scene's 'origin' a 'crs' to "
               "take it to, such as \"EPSG:25832\"",
               raster, from.name()));
  return nullptr;
}

}  // namespace ifov::session
