#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/parallel.h"
#include "geometry/world.h"
#include "sampling/random.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "session/solved/second_pass.h"

namespace ifov::session {
namespace {

using Spent = exposure::SolvedSurface::Spent;
/// A point of the surface that is asked about, and another that the same pixel sees, with the surface of that.
struct PointsOfPixel {
  geometry::SurfacePoint point, other;
  const exposure::SolvedSurface* surface_of_other;
};

constexpr int kPixelsAcross = 24;                           // pixels along each side of the image
constexpr std::size_t kMostPoints = 96, kLeastPoints = 16;  // of a material
constexpr int kDraws = 4, kDrawsOfMeans = 8;
constexpr std::uint64_t kOwnRays = 0x5be9d1;
constexpr std::array<int, 4> kSunPairs{1, 2, 3, exposure::SolvedSurface::kSunPairs};
constexpr double kLeastChance = 0.1;
// What a path costs with its rays to the sky, what a pair of rays to the Sun adds, and what is asked about a point: measured in a wood.
constexpr double kPath = 6.0, kSunPair = 0.8, kAbout = 9.5;  // us

/// Of temperatures: what a pixel's points scatter about its mean, what rays add for each number of pairs to the Sun, and what is about a point.
struct Scatter {
  double places_k2 = 0.0;
  std::array<double, kSunPairs.size()> rays_k2{};
  double beside_k2 = 0.0, beside_rays_k2 = 0.0;  ///< squares of what is not as it is taken for, those of rays
};

/// What is about points that an image sees, in the mean.
Spent means_about(const exposure::SolvedSurface& surface, std::span<const PointsOfPixel> seen) {
  Spent means;
  double above = 0.0, below = 0.0;
  const auto add = [](exposure::SolvedSurface::Warmth& mean, double& count,
                      const std::optional<exposure::SolvedSurface::Warmth>& one) {
    if (!one) return;
    count += 1.0;
    mean.in_shade_k += (one->in_shade_k - mean.in_shade_k) / count;
    mean.of_sun_k += (one->of_sun_k - mean.of_sun_k) / count;
  };
  for (std::size_t k = 0; k < seen.size(); ++k)
    for (int draw = 0; draw < kDrawsOfMeans; ++draw) {
      const auto asked = surface.asked_about(seen[k].point, sampling::hash(kOwnRays, k, draw, kDrawsOfMeans));
      add(means.above, above, asked.above);
      add(means.below, below, asked.below);
    }
  return means;
}

Scatter scatter_of(const exposure::SolvedSurface& surface, const Spent& means,
                   std::span<const PointsOfPixel> seen) {
  const exposure::SolvedSurface whole = surface.spending(means);
  std::vector<exposure::SolvedSurface> alone;
  for (const int pairs : kSunPairs) alone.push_back(surface.spending({pairs, 0.0, means.above, means.below}));
  Scatter found;
  const auto points = static_cast<double>(seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    double apart_k = 0.0, noise_k2 = 0.0, mean_k = 0.0;
    const auto add = [&](const scene::EstimatedTemperature& one, double sign) {
      apart_k += sign * one.kelvin / kDraws;
      noise_k2 += one.deviation_k * one.deviation_k / (kDraws * kDraws);
    };
    std::array<double, kDraws> beside_k{};
    for (int draw = 0; draw < kDraws; ++draw) {
      const std::uint64_t key = sampling::hash(kOwnRays, k, draw);
      const scene::EstimatedTemperature all = whole.at(seen[k].point, key, 1.0);
      add(all, 1.0);
      add(seen[k].surface_of_other->at(seen[k].other, sampling::hash(kOwnRays, k, draw, 1), 1.0), -1.0);
      for (std::size_t n = 0; n < alone.size(); ++n) {
        const scene::EstimatedTemperature one = alone[n].at(seen[k].point, key, 1.0);
        found.rays_k2[n] += one.deviation_k * one.deviation_k / (points * kDraws);
        if (n + 1 == alone.size()) beside_k[static_cast<std::size_t>(draw)] = all.kelvin - one.kelvin;
      }
      mean_k += beside_k[static_cast<std::size_t>(draw)] / kDraws;
    }
    for (const double one_k : beside_k) {
      found.beside_k2 += one_k * one_k / (points * kDraws);
      found.beside_rays_k2 += (one_k - mean_k) * (one_k - mean_k) / (points * (kDraws - 1));
    }
    found.places_k2 += (0.5 * apart_k * apart_k - 0.5 * noise_k2) / points;
  }
  found.places_k2 = std::max(0.0, found.places_k2);
  return found;
}

/// What an image is best to spend on the temperature of a surface's points: where temperatures differ more within pixels than rays scatter
/// them, more paths are worth more than more rays. By rays that images do not take: the same whoever asks, and independent of theirs.
Spent spending_of(const exposure::SolvedSurface& surface, std::span<const PointsOfPixel> seen) {
  if (seen.size() < kLeastPoints) return {};
  const std::size_t count = std::min(seen.size(), kMostPoints);
  std::vector<PointsOfPixel> some;
  for (std::size_t k = 0; k < count; ++k) some.push_back(seen[k * seen.size() / count]);
  const Spent means = means_about(surface, some);
  const Scatter found = scatter_of(surface, means, some);
  Spent best = means;
  double least = 1e300;
  for (std::size_t n = 0; n < kSunPairs.size(); ++n) {
    // Of variance and cost the product, a / p + b times c + d p, is least at p = sqrt(a c / (b d)).
    const double asked_k2 = found.beside_k2,
                 other_k2 = found.places_k2 + found.rays_k2[n] + found.beside_rays_k2 - asked_k2;
    const double paths = kPath + kSunPair * kSunPairs[n];
    double chance = 1.0;
    if (other_k2 > 0.0)
      chance = std::clamp(std::sqrt(asked_k2 * paths / (other_k2 * kAbout)), kLeastChance, 1.0);
    const double costs = (other_k2 + asked_k2 / chance) * (paths + kAbout * chance);
    if (costs < least) {
      least = costs;
      best.sun_pairs = kSunPairs[n];
      best.chance_beside = chance;
    }
  }
  return best;
}

/// Of each material points that the camera sees, each with another one of its pixel, over a grid of the image.
std::map<std::uint32_t, std::vector<PointsOfPixel>> points_of_pixels(
    const scene::Scene& scene, const sensor::Camera& camera, const ByMaterial& by_material,
    const std::map<std::uint32_t, std::uint32_t>& firsts) {
  std::vector<sampling::FocalPoint> points;
  for (const sampling::FocalPoint& middle : sensor::grid_over(camera, kPixelsAcross, kPixelsAcross))
    for (const std::uint64_t which : {0, 1}) {
      points.push_back(middle);
      const auto within = [&](double at_px, std::uint64_t axis) {
        return std::floor(at_px) +
               sampling::unit_double(sampling::hash(kOwnRays, points.size(), which, axis));
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
  for (std::size_t k = 0; k < hits.size(); ++k)
    if (const auto own = first_of(hits[k]), other = first_of(hits[k ^ 1]); own && other)
      found[*own].push_back({hits[k], hits[k ^ 1], by_material.at(*other).surface.get()});
  return found;
}

}  // namespace

void choose_spending(scene::Scene& scene, const sensor::Camera& camera, ByMaterial& by_material,
                     const std::map<std::uint32_t, std::uint32_t>& firsts, int threads) {
  const auto seen = points_of_pixels(scene, camera, by_material, firsts);
  std::vector<std::pair<std::uint32_t, exposure::SolvedSurface::Spent>> chosen;
  for (const auto& [first, pairs] : seen) chosen.emplace_back(first, exposure::SolvedSurface::Spent{});
  parallel_for(static_cast<std::int64_t>(chosen.size()), threads, [&](std::int64_t k) {
    auto& [first, spent] = chosen[static_cast<std::size_t>(k)];
    spent = spending_of(*by_material.at(first).surface, seen.at(first));
  });
  const std::map<std::uint32_t, exposure::SolvedSurface::Spent> by_first(chosen.begin(), chosen.end());
  for (auto& [material, solved] : by_material)
    if (const auto found = by_first.find(firsts.at(material)); found != by_first.end())
      scene.solved[material] = solved.surface =
          std::make_shared<const exposure::SolvedSurface>(solved.surface->spending(found->second));
}

}  // namespace ifov::session
