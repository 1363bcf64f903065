#pragma once

#include <cstdint>
#include <vector>

#include "session/assembly/geometry/placed_objects.h"

namespace ifov::session {

struct Parts;

/// What some thousand rays of the camera, one path each, and a pass over the objects say of a loaded scene. It is for
/// people: nothing of the result is taken from it.
struct SceneSurvey {
  std::size_t rays = 0;
  double sky_share = 0.0;   ///< of rays that meet nothing
  double down_share = 0.0;  ///< of rays that meet nothing and leave below the horizon
  struct Range {
    double low = 0.0, high = 0.0;
  };
  std::vector<Range> radiance;        ///< by channel, W m-2 sr-1 um-1; of single paths
  std::vector<Range> sun, sky;        ///< by channel: irradiance on level ground, W m-2 um-1; low = high
  Range distance_m, gsd_m;            ///< to what is met; empty (low > high) where nothing is
  Range x_m, y_m;                     ///< of what is met, scene frame
  std::size_t objects = 0;            ///< of the world
  std::vector<std::size_t> in_frame;  ///< by object of the document: copies whose place the picture holds
  std::vector<std::size_t> surveyed;  ///< of so many: all, or a part of very many, evenly taken
  /// Pairs of objects of the document with surfaces in one place, and the share of the picture that sees them.
  struct Shared {
    std::size_t seen = 0, hidden = 0;
    double share = 0.0;
  };
  std::vector<Shared> shared;
};

SceneSurvey survey_scene(const Parts& parts);

}  // namespace ifov::session
