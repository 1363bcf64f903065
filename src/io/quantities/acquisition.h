#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace ifov::io {

/// When, from where and in which light an image was taken. Lengths in metres, positions in map coordinates (those of the
/// scene where it has none), directions east-north-up, azimuths clockwise from north.
struct Acquisition {
  struct Position {
    double latitude_deg = 0.0, longitude_deg = 0.0;  ///< WGS 84
  };
  struct Light {
    double zenith_deg = 0.0, azimuth_deg = 0.0;  ///< of the direction towards it
    bool is_moon = false;
  };
  struct Pose {
    math::Point3 position_m;
    math::Vec3 right, down, forward;  ///< as of the camera
  };
  /// How a camera that moves stood in a line of the image, as its platform reports it.
  struct Line {
    double line = 0.0;    ///< y of the image: 0.5 is the middle of the first line
    double time_s = 0.0;  ///< after `time`
    Pose pose;
    std::optional<Pose> truth;  ///< where that is another
  };
  /// As it is reported.
  struct Camera {
    std::string model = "orthographic";          ///< its key in documents
    std::optional<math::Point3> position_m;      ///< none where rays are parallel
    math::Vec3 right, down, forward;             ///< unit vectors: image x, image y, the line of sight
    double focal_length_m = 0.0, pitch_m = 0.0;  ///< 0 where rays are parallel
    /// Side of a pixel on the ground; where rays diverge at the image's middle; 0: not known.
    double ground_sample_m = 0.0;
    /// Of a camera that moves, at most kMostLines of them, from the first to the last; what is said above is then of the middle line.
    std::vector<Line> lines;
    static constexpr int kMostLines = 65;
  };
  /// Where the ray through a corner of the image meets the scene.
  struct Corner {
    math::Point3 position_m;
    std::optional<Position> position;
  };

  std::string time;                ///< UTC, ISO 8601; empty: the document states none
  std::optional<Light> light;      ///< the Sun or the Moon
  std::optional<Position> origin;  ///< of the scene
  double origin_height_m = 0.0;
  math::Point3 origin_on_map_m;
  Camera camera;
  /// Clockwise from the upper left; none where the ray meets nothing.
  std::vector<std::optional<Corner>> footprint;
};

}  // namespace ifov::io
