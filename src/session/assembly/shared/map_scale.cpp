#include "session/assembly/shared/map_scale.h"

#include <algorithm>
#include <filesystem>

#include "core/format.h"
#include "geometry/world.h"
#include "sensor/camera.h"

namespace ifov::session {

namespace {

constexpr double kMuch = 10.0;

}  // namespace

double ground_sample_m(const sensor::Camera& camera, const geometry::World& world) {
  const geometry::World::Bounds bounds = world.bounds();
  return camera.gsd_m(bounds.low_m + (bounds.high_m - bounds.low_m) * 0.5);
}

std::vector<std::string> scale_statements(const std::vector<MapScale>& scales, double ground_sample_m) {
  std::vector<std::string> lines;
  if (!(ground_sample_m > 0.0)) return lines;
  const auto add = [&](std::string line) {  // once for a map that lies in several places
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
  };
  for (const MapScale& scale : scales) {
    const std::string name = std::filesystem::path(scale.path).filename().string();
    const double small = std::min(scale.cell_width_m, scale.cell_height_m);
    const double large = std::max(scale.cell_width_m, scale.cell_height_m);
    const std::string cells =
        small == large ? format("cells of {:.3g} m", small)
                       : format("cells of {:.3g} m x {:.3g} m", scale.cell_width_m, scale.cell_height_m);
    if (large * kMuch < ground_sample_m)
      add(
          format("map '{}': {} are {:.3g} times finer than the ground sample of {:.3g} m; what they hold is "
                 "seen as means of many of them",
                 name, cells, ground_sample_m / large, ground_sample_m));
    else if (small > kMuch * ground_sample_m)
      add(
          format("map '{}': {} are {:.3g} times coarser than the ground sample of {:.3g} m; their edges will "
                 "be seen",
                 name, cells, small / ground_sample_m, ground_sample_m));
  }
  return lines;
}

}  // namespace ifov::session
