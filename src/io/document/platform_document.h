#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "geodesy/attitude.h"
#include "geodesy/utc_time.h"
#include "io/document/document_values.h"
#include "io/document/scene_document.h"
#include "math/vec3.h"

namespace ifov::io {

/// Frames of paths. Of the scene: its east, north, up about its origin, in the document's coordinates. Geodetic: longitude,
/// latitude, height above the ellipsoid WGS 84. ECEF: Earth-centred, Earth-fixed.
enum class PathFrame { scene, geodetic, ecef };

struct StraightPath {
  math::Point3 position_m;  ///< at 0 s
  std::array<double, 3> velocity_m_s{};
};

struct WayPoint {
  double time_s = 0.0;
  math::Point3 position_m;
  friend bool operator==(const WayPoint&, const WayPoint&) = default;
};
struct WayPointPath {
  std::vector<WayPoint> points;
};

struct TablePath {
  PathFrame frame = PathFrame::scene;
  DocumentFile file;
};

/// Of two-line elements, in TEME.
struct OrbitPath {
  DocumentFile file;
  double ut1_minus_utc_s = 0.0;
};

/// Of a platform that holds it.
struct PlatformAttitude {
  geodesy::Attitude angles;
  bool from_track = true;  ///< yaw is counted from where the platform flies to; else from north
};

struct PlatformDocument {
  std::variant<StraightPath, WayPointPath, TablePath, OrbitPath> path;
  std::optional<PlatformAttitude> attitude;  ///< none: what the path's table says, or level, the nose ahead
  SourcePosition position;
};

/// A platform, and when and where in the world it flies.
struct PlatformFlight {
  PlatformDocument platform;
  std::optional<geodesy::UtcTime> time;
  OriginDocument origin;
};

}  // namespace ifov::io
