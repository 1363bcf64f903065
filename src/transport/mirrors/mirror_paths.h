#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "math/ray.h"
#include "sampling/field.h"
#include "scene/scene.h"
#include "transport/mirrors/sun_images.h"
#include "transport/mirrors/sun_mirrors.h"

namespace ifov::transport {

/// A ray towards an image of the Sun, on its way from mirror to mirror.
struct MirrorPath {
  static constexpr std::uint32_t kRound = SunMirrors::kNone;
  std::uint32_t image = kRound;  ///< in flat mirrors; kRound: in a round one
  std::uint32_t object = 0;      ///< that round one
  math::Point3 at;               ///< where on it
  math::Vec3 towards_sun;        ///< from there
  math::Ray ray;
  std::array<std::uint16_t, SunImages::kMostReflections> facings{};  ///< of the flat ones met
  std::uint8_t count = 0;                                            ///< of mirrors met
  double share = 1.0;  ///< of light that comes this way, at most: kept where there are panes
};

/// Whether a ray met a place that it was sent to, by the accuracy of a ray tracer.
inline bool is_at(const geometry::SurfacePoint& hit, math::Point3 position) {
  constexpr double kSamePosition = 1e-6;  // in parts of the way there
  return math::length(hit.position_m - position) <= kSamePosition * (1.0 + hit.distance_m);
}

/// Whether a ray that met this surface is reflected as it was meant to be; then it goes on from there.
bool reflect(MirrorPath& way, const SunMirrors& mirrors, const geometry::SurfacePoint& hit,
             const scene::ResolvedSurface& surface);

/// Whether a constituent reflects as a mirror.
inline bool is_mirror(const scene::Scene& scene, const scene::Constituent& part) {
  return scene.materials[part.material].bsdf->is_delta();
}

/// Traces ways until they reach the Sun or do not. An object serves one thread.
class MirrorTracer {
 public:
  /// `panes`: whether there are any, by which light goes straight on.
  MirrorTracer(const scene::Scene& scene, const SunMirrors& mirrors, const SunImages& images, bool panes)
      : scene_(scene), mirrors_(mirrors), images_(images), panes_(panes) {}

  /// `ways`: of a type derived from MirrorPath; used up. `met(way, hit, surface)`: at each mirror that a way is reflected
  /// by; `reached(way)`: at those that come to the Sun; where there are panes `share(way, hit, surface, through)`: what a surface
  /// lets through, or reflects, at most, and `passed(way, hit, surface)`: at each pane that a way comes through, before it goes on.
  template <class Way, class Met, class Reached, class Share, class Passed>
  void trace(std::vector<Way>& ways, sampling::RayCounts& counts, const Met& met, const Reached& reached,
             const Share& share, const Passed& passed) {
    if (panes_) return trace_by_panes(ways, counts, met, reached, share, passed);
    // A ray that leaves after mirrors which make its image has reached the Sun.
    const int most = std::max(images_.reflections(), 1);
    for (int reflections = 0; reflections <= most && !ways.empty(); ++reflections) {
      rays_.clear();
      for (const Way& way : ways) rays_.push_back(way.ray);
      hits_.resize(rays_.size());
      scene_.world->intersect(rays_, hits_);
      counts.shadow += rays_.size();
      std::size_t kept = 0;
      for (std::size_t k = 0; k < ways.size(); ++k) {
        Way& way = ways[k];
        if (!hits_[k].hit()) {
          if (is_image(way)) reached(way);
          continue;
        }
        if (reflections == most) continue;
        const scene::ResolvedSurface surface = scene_.resolve_without_temperature(hits_[k]);
        if (!mirrors_at(surface) || !reflect(way, mirrors_, hits_[k], surface)) continue;
        met(way, hits_[k], surface);
        ways[kept++] = way;
      }
      ways.resize(kept);
    }
    ways.clear();
  }

 private:
  /// The same where a pane both reflects light and lets it through: a way goes on as two.
  template <class Way, class Met, class Reached, class Share, class Passed>
  void trace_by_panes(std::vector<Way>& ways, sampling::RayCounts& counts, const Met& met,
                      const Reached& reached, const Share& share_of, const Passed& passed) {
    const auto most = static_cast<std::uint8_t>(std::max(images_.reflections(), 1));
    std::vector<Way> next;
    for (int hits = 0; hits < kMostHits && !ways.empty(); ++hits) {
      rays_.clear();
      for (const Way& way : ways) rays_.push_back(way.ray);
      hits_.resize(rays_.size());
      scene_.world->intersect(rays_, hits_);
      counts.shadow += rays_.size();
      next.clear();
      for (std::size_t k = 0; k < ways.size(); ++k) {
        const Way& way = ways[k];
        const geometry::SurfacePoint& hit = hits_[k];
        if (!hit.hit()) {
          if (is_image(way)) reached(ways[k]);
          continue;
        }
        const scene::ResolvedSurface surface = scene_.resolve_without_temperature(hit);
        if (const double share = share_of(way, hit, surface, true); way.share * share > kNegligible) {
          Way through = way;
          through.share *= share;
          passed(through, hit, surface);
          const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
          through.ray = way.ray.onward(hit.position_m - hit.offset_m * outward, way.ray.direction);
          next.push_back(through);
        }
        if (way.count >= most || !mirrors_at(surface)) continue;
        Way back = way;
        back.share *= share_of(way, hit, surface, false);
        if (!(back.share > kNegligible) || !reflect(back, mirrors_, hit, surface)) continue;
        met(back, hit, surface);
        next.push_back(back);
      }
      ways.swap(next);
    }
    ways.clear();
  }

  /// Ways that bring less than this of the light at their end are left out; those between two panes that meet more than so many
  /// surfaces have come to that.
  static constexpr double kNegligible = 1e-6;
  static constexpr int kMostHits = 256;

  bool mirrors_at(const scene::ResolvedSurface& surface) const;
  bool is_image(const MirrorPath& way) const;

  const scene::Scene& scene_;
  const SunMirrors& mirrors_;
  const SunImages& images_;
  bool panes_;
  std::vector<math::Ray> rays_;
  std::vector<geometry::SurfacePoint> hits_;
};

}  // namespace ifov::transport
