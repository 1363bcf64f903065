#include "io/document/cameras/framed_places.h"

#include <cmath>

#include "core/error.h"
#include "geodesy/geodetic.h"
#include "geodesy/orbit/teme.h"
#include "io/document/framed_point.h"
#include "io/document/origin_document.h"
#include "io/document/platform_document.h"

namespace ifov::io {

geodesy::FrameTransform<geodesy::Ecef, geodesy::Enu> ecef_from_scene(const OriginDocument& origin) {
  return geodesy::ecef_from_enu(
      {origin.geographic->latitude_rad, origin.geographic->longitude_rad, origin.height_m});
}

void take_from_map(const DocumentName& crs, std::span<math::Point3> places, const SceneFrame& scene) {
  if (scene.maps == nullptr) throw InputError("a place on a map needs a scene that lies on one");
  scene.maps->to_scene(crs, places);
}

math::Point3 scene_point(const FramedPoint& point, const OriginDocument& origin, const SceneFrame& scene) {
  math::Point3 place{point.place[0], point.place[1], point.place[2]};
  if (point.frame == PathFrame::scene) return place - scene.offset_m;
  if (point.frame == PathFrame::map) {
    take_from_map(point.crs, {&place, 1}, scene);
    return place;
  }
  return ecef_from_scene(origin).inverse()(ecef_point(point.frame, point.place)).p;
}

geodesy::EcefPoint ecef_point(PathFrame frame, const std::array<double, 3>& place) {
  const auto [x, y, z] = place;
  return frame == PathFrame::geodetic ? geodesy::ecef_from_geodetic({y, x, z})
                                      : geodesy::EcefPoint{{x, y, z}};
}

geodesy::EarthOrientation orientation_of(const EarthTurnDocument& turn) {
  const std::array<double, 2> pole = turn.pole_rad.value_or(std::array<double, 2>{});
  return {turn.ut1_minus_utc_s.value_or(0.0), pole[0], pole[1]};
}

geodesy::FrameTransform<geodesy::Ecef, Stars> ecef_from_stars(PathFrame frame, const geodesy::UtcTime& time,
                                                              const EarthTurnDocument& turn) {
  const auto of_axes = [](const auto& transform) -> geodesy::FrameTransform<geodesy::Ecef, Stars> {
    return {transform.x(), transform.y(), transform.z()};
  };
  return frame == PathFrame::gcrs ? of_axes(geodesy::ecef_from_gcrs(time, orientation_of(turn)))
                                  : of_axes(geodesy::ecef_from_teme(time, orientation_of(turn)));
}

std::string turn_remark(const EarthTurnDocument& turn, double latitude_rad) {
  // The most that UT1 and UTC differ by (ITU-R TF.460), and that the pole has been from its place.
  constexpr double kMost_s = 0.9, kTurn_rad_s = 7.292115e-5, kRadius_m = 6378137.0, kMostPole_m = 20.0;
  std::string text;
  double off_m = 0.0;
  if (!turn.ut1_minus_utc_s) {
    text = "UT1 - UTC";
    off_m += kMost_s * kTurn_rad_s * kRadius_m * std::cos(latitude_rad);
  }
  if (!turn.pole_rad) {
    text += text.empty() ? "polar motion" : " and polar motion";
    off_m += kMostPole_m;
  }
  return text.empty() ? text : format(", {} not given (up to {:.0f} m on the ground)", text, off_m);
}

}  // namespace ifov::io
