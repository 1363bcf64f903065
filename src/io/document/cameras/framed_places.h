#pragma once

#include <array>
#include <span>
#include <string>

#include "geodesy/earth_orientation.h"
#include "geodesy/frames.h"
#include "math/vec3.h"

namespace ifov::io {

struct DocumentName;
struct EarthTurnDocument;
struct FramedPoint;
struct OriginDocument;
enum class PathFrame;

/// What takes coordinates of maps to the scene.
class SceneMaps {
 public:
  virtual ~SceneMaps() = default;
  /// Eastings, northings and heights (m) of the map of that name, of the origin's where it is empty: to the scene, in place. InputError
  /// where there is no such map, or no way from it to the scene's.
  virtual void to_scene(const DocumentName& crs, std::span<math::Point3> places) const = 0;
};

/// Where a scene is that paths lead through.
struct SceneFrame {
  math::Vec3 offset_m = {};         ///< of coordinates in the document; to be subtracted
  const SceneMaps* maps = nullptr;  ///< null: paths on maps are an error
};

/// Of a scene whose origin has latitude and longitude.
geodesy::FrameTransform<geodesy::Ecef, geodesy::Enu> ecef_from_scene(const OriginDocument& origin);

/// A place in the scene, of a frame that is not among the stars.
math::Point3 scene_point(const FramedPoint& point, const OriginDocument& origin, const SceneFrame& scene);

/// Places of a map in the scene.
void take_from_map(const DocumentName& crs, std::span<math::Point3> places, const SceneFrame& scene);

/// From ECEF, geodetic coordinates (as of FramedPoint), or a frame among the stars at a time.
geodesy::EcefPoint ecef_point(PathFrame frame, const std::array<double, 3>& place);
struct Stars {};
geodesy::FrameTransform<geodesy::Ecef, Stars> ecef_from_stars(PathFrame frame, const geodesy::UtcTime& time,
                                                              const EarthTurnDocument& turn);

geodesy::EarthOrientation orientation_of(const EarthTurnDocument& turn);

/// ", UT1 - UTC not given (up to 258 m on the ground)": what is not told of the Earth's turn, at a latitude; empty: all is.
std::string turn_remark(const EarthTurnDocument& turn, double latitude_rad);

}  // namespace ifov::io
