#include "io/document/cameras/framed_places.h"

#include "geodesy/geodetic.h"
#include "io/document/framed_point.h"
#include "io/document/origin_document.h"

namespace ifov::io {

geodesy::FrameTransform<geodesy::Ecef, geodesy::Enu> ecef_from_scene(const OriginDocument& origin) {
  return geodesy::ecef_from_enu(
      {origin.geographic->latitude_rad, origin.geographic->longitude_rad, origin.height_m});
}

math::Point3 scene_point(const FramedPoint& point, const OriginDocument& origin, math::Vec3 offset_m) {
  const auto [x, y, z] = point.place;
  if (point.frame == PathFrame::scene) return math::Point3{x, y, z} - offset_m;
  const geodesy::EcefPoint place = point.frame == PathFrame::geodetic ? geodesy::ecef_from_geodetic({y, x, z})
                                                                      : geodesy::EcefPoint{{x, y, z}};
  return ecef_from_scene(origin).inverse()(place).p;
}

}  // namespace ifov::io
