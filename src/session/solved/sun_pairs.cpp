#include "session/solved/sun_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "exposure/point_rays.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "sampling/random.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::session {
namespace {

constexpr int kPixelsAcross = 24;                        // pixels along each side of the image
constexpr std::size_t kMostPairs = 24, kLeastPairs = 6;  // of a material
constexpr int kPilotDraws = 4;
constexpr std::uint64_t kPilotKey = 0x50a1;
// What a path costs beside a pair of rays to the Sun, in pairs: measured in a wood and in streets.
constexpr double kOfPath = 4.0;

/// Of temperatures: between the points of a pixel, and what rays scatter.
struct Scatter {
  double places_k2 = 0.0, rays_k2 = 0.0;
};

Scatter scatter_of(const exposure::SolvedSurface& surface, std::span<const PointsOfPixel> seen) {
  Scatter found;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    double apart_k = 0.0, rays_k2 = 0.0;
    for (int draw = 0; draw < kPilotDraws; ++draw) {
      const auto one = surface.at(seen[k].first, sampling::hash(kPilotKey, k, draw, 0)),
                 other = surface.at(seen[k].second, sampling::hash(kPilotKey, k, draw, 1));
      apart_k += (one.kelvin - other.kelvin) / kPilotDraws;
      rays_k2 +=
          0.5 * (one.deviation_k * one.deviation_k + other.deviation_k * other.deviation_k) / kPilotDraws;
    }
    found.places_k2 += (0.5 * apart_k * apart_k - rays_k2 / kPilotDraws) / static_cast<double>(seen.size());
    found.rays_k2 += rays_k2 / static_cast<double>(seen.size());
  }
  found.places_k2 = std::max(0.0, found.places_k2);
  return found;
}

}  // namespace

int sun_pairs_worth(const exposure::SolvedSurface& surface, std::span<const PointsOfPixel> seen) {
  constexpr int kAll = exposure::SolvedSurface::kSunPairs;
  if (seen.size() < kLeastPairs) return kAll;
  seen = seen.first(std::min(seen.size(), kMostPairs));
  const Scatter of_all = scatter_of(surface, seen);
  int best = kAll;
  double least = (of_all.places_k2 + of_all.rays_k2) * (kOfPath + kAll);
  for (const int pairs : {1, 2}) {
    const double rays_k2 = scatter_of(surface.with_sun_pairs(pairs), seen).rays_k2;
    const double costs = (of_all.places_k2 + rays_k2) * (kOfPath + pairs);
    if (costs < least) least = costs, best = pairs;
  }
  return best;
}

std::map<std::uint32_t, std::vector<PointsOfPixel>> points_of_pixels(
    const scene::Scene& scene, const sensor::Camera& camera,
    const std::map<std::uint32_t, std::uint32_t>& firsts) {
  std::vector<sampling::FocalPoint> points;
  for (const sampling::FocalPoint& middle : sensor::grid_over(camera, kPixelsAcross, kPixelsAcross))
    for (const std::uint64_t which : {0, 1}) {
      points.push_back(middle);
      const auto within = [&](double at_px, std::uint64_t axis) {
        return std::floor(at_px) +
               sampling::unit_double(sampling::hash(kPilotKey, points.size(), which, axis));
      };
      points.back().x_px = within(middle.x_px, 0);
      points.back().y_px = within(middle.y_px, 1);
    }
  std::vector<math::Ray> rays(points.size());
  camera.rays(points, rays);
  std::vector<geometry::SurfacePoint> hits(points.size());
  scene.world->intersect(rays, hits);
  std::map<std::uint32_t, std::vector<PointsOfPixel>> found;
  const auto first_of = [&](const geometry::SurfacePoint& hit) {
    const std::uint32_t by =
        hit.hit() ? scene.states[scene.resolve_without_temperature(hit).constituents[0].state].solved : 0;
    return by > 0 ? std::optional(firsts.at(by - 1)) : std::nullopt;
  };
  for (std::size_t k = 0; k + 1 < hits.size(); k += 2)
    if (const auto first = first_of(hits[k]); first && first_of(hits[k + 1]) == first)
      found[*first].emplace_back(hits[k], hits[k + 1]);
  return found;
}

}  // namespace ifov::session
