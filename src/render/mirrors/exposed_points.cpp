#include "render/mirrors/exposed_points.h"

#include <algorithm>

#include "geometry/world.h"
#include "render/mirrors/glint_search.h"
#include "sampling/random.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::render {
namespace {

constexpr std::size_t kFewestTimes = 4, kMostTimes = 64;
/// About how many are traced together.
constexpr std::size_t kSpreadTogether = 16384;
constexpr std::uint64_t kTimesOfPoints = 0x74696d6573ull;

}  // namespace

void spread_over_exposure(const scene::Scene& scene, const sensor::Camera& camera, std::uint64_t seed,
                          std::vector<GlintPoint>& points) {
  const double exposure_s = camera.exposure_s();
  if (points.empty() || scene.world->moving() == nullptr || !(exposure_s > 0.0) ||
      camera.moves_while_exposed())
    return;
  const std::size_t times = std::clamp(kSpreadTogether / points.size(), kFewestTimes, kMostTimes);
  std::vector<GlintPoint> spread;
  spread.reserve(times * points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t t = 0; t < times; ++t) {
      GlintPoint point = points[k];
      const double u = sampling::unit_double(sampling::hash(seed, kTimesOfPoints, k, t));
      point.image.time_s = exposure_s * ((static_cast<double>(t) + u) / static_cast<double>(times) - 0.5);
      point.area /= static_cast<double>(times);
      spread.push_back(point);
    }
  points = std::move(spread);
}

}  // namespace ifov::render
