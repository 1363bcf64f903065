#pragma once

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
  MirrorTracer(const scene::Scene& scene, const SunMirrors& mirrors, const SunImages& images)
      : scene_(scene), mirrors_(mirrors), images_(images) {}

  /// `ways`: of a type derived from MirrorPath; used up. `met(way, hit, surface)`: at each mirror that a way is reflected
  /// by; `reached(way)`: at those that come to the Sun.
  template <class Way, class Met, class Reached>
  void trace(std::vector<Way>& ways, sampling::RayCounts& counts, const Met& met, const Reached& reached) {
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
        const scene::ResolvedSurface surface = scene_.resolve(hits_[k]);
        if (!mirrors_at(surface) || !reflect(way, mirrors_, hits_[k], surface)) continue;
        met(way, hits_[k], surface);
        ways[kept++] = way;
      }
      ways.resize(kept);
    }
    ways.clear();
  }

 private:
  bool mirrors_at(const scene::ResolvedSurface& surface) const;
  bool is_image(const MirrorPath& way) const;

  const scene::Scene& scene_;
  const SunMirrors& mirrors_;
  const SunImages& images_;
  std::vector<math::Ray> rays_;
  std::vector<geometry::SurfacePoint> hits_;
};

}  // namespace ifov::transport
