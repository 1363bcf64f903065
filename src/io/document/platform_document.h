#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geodesy/attitude.h"
#include "geodesy/utc_time.h"
#include "io/document/document_values.h"
#include "io/document/framed_point.h"
#include "io/document/origin_document.h"
#include "math/vec3.h"

namespace ifov::io {

struct MountList;

/// Of what stands, or hovers.
struct FixedPath {
  FramedPoint at;
};

/// Around a point of the path's height, level in the scene. One of speed and period.
struct CirclingPath {
  FramedPoint center;
  double radius_m = 0.0;
  std::optional<double> speed_m_s, period_s;
  double start_rad = 0.0;  ///< from the center to the platform at 0 s: clockwise from north
  bool clockwise = true;   ///< seen from above
  bool banked = false;     ///< as in a coordinated turn
};

struct StraightPath {
  FramedPoint at;                        ///< at 0 s
  std::array<double, 3> velocity_m_s{};  ///< east, north, up of the place; ECEF: along its axes
};

struct WayPoint {
  double time_s = 0.0;
  std::array<double, 3> place{};  ///< as of FramedPoint
  friend bool operator==(const WayPoint&, const WayPoint&) = default;
};
struct WayPointPath {
  PathFrame frame = PathFrame::scene;
  DocumentName crs;
  std::vector<WayPoint> points;
};

/// How the Earth is turned among the stars, as the IERS publishes it; none: taken for 0.
struct EarthTurnDocument {
  std::optional<double> ut1_minus_utc_s;
  std::optional<std::array<double, 2>> pole_rad;
};

struct TablePath {
  PathFrame frame = PathFrame::scene;
  DocumentName crs;
  EarthTurnDocument turn;
  DocumentFile file;
};

/// Where a satellite was and how fast, Earth-centred (m, m/s): in GCRS, TEME or ECEF.
struct OrbitState {
  PathFrame frame = PathFrame::gcrs;
  math::Point3 position_m;
  std::array<double, 3> velocity_m_s{};
  geodesy::UtcTime epoch;
};

struct OrbitPath {
  std::variant<DocumentFile, OrbitState> source;  ///< two-line elements, in TEME; or a state
  EarthTurnDocument turn;
};

/// Where the belly (nadir: along the local vertical; geocentric: to the Earth's centre) or the nose (velocity) is without angles.
enum class PlatformAxes { nadir, geocentric, velocity };

/// What the nose is towards, as far as the axes let it: where the platform flies to over the ground, or among the stars, or north.
enum class YawFrom { track, orbit, north };

/// Of a platform that holds it.
struct PlatformAttitude {
  geodesy::Attitude angles;          ///< about what follows from the rest
  std::optional<PlatformAxes> axes;  ///< none: nadir, or with the belly to `look_at`
  std::optional<FramedPoint> look_at;
  std::optional<YawFrom> from;  ///< none: the track, or north of what is fixed
};

/// Power spectra of the body's turns about its own axes, of these standard deviations.
struct WhiteJitter {
  geodesy::Attitude rms;
  double up_to_hz = 0.0;
};
struct FallingJitter {
  geodesy::Attitude rms;
  double corner_hz = 0.0, slope = 0.0, up_to_hz = 0.0;
};
struct TabulatedJitter {
  DocumentFile file;  ///< docs/formats/paths.md
};
using JitterDocument = std::variant<WhiteJitter, FallingJitter, TabulatedJitter>;

/// What the platform's receiver and inertial unit say: path and attitude without jitter, and their errors.
struct ReportedPose {
  math::Vec3 position_bias_m, position_noise_m;  ///< east, north, up; standard deviations
  geodesy::Attitude attitude_bias, attitude_noise;
  double noise_up_to_hz = 1.0;
  std::shared_ptr<const MountList> mounts;  ///< as measured, but for their motion; null: as they are
};

struct PlatformDocument {
  std::variant<StraightPath, FixedPath, CirclingPath, WayPointPath, TablePath, OrbitPath> path;
  std::optional<PlatformAttitude> attitude;  ///< none: what the path's table says, or level, the nose ahead
  std::shared_ptr<const MountList> mounts;   ///< null: none
  std::optional<JitterDocument> jitter;
  std::optional<ReportedPose> reported;  ///< none: the pose is known
  SourcePosition position;
};

/// A platform, and when and where in the world it flies.
struct PlatformFlight {
  PlatformDocument platform;
  std::optional<geodesy::UtcTime> time;
  OriginDocument origin;
  std::uint64_t seed = 1;
  std::map<std::string, std::shared_ptr<const PlatformDocument>> tracked = {};  ///< of gimbals, by object
};

}  // namespace ifov::io
