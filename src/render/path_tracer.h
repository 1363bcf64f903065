#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "materials/scattering.h"
#include "math/ray.h"
#include "render/path_record.h"
#include "render/spectral_scene.h"
#include "render/surface_lobe.h"
#include "sampling/field.h"
#include "sampling/warp.h"

namespace ifov::render {

/// The random numbers of a path: element `index` of the scrambled sequence `sequence`.
struct PathKey {
  std::uint64_t sequence = 0;
  std::uint32_t index = 0;
};

struct TransportOptions {
  /// Surfaces a path may scatter at: 0 emission and sky only, 1 adds direct sun; negative: no limit, paths end by
  /// Russian roulette without bias.
  int maximum_scatterings = -1;
};

/// Finds paths, breadth first: a batch advances together, one bounce at a time, so that the ray tracer sees large
/// batches. Next-event estimation to the Sun (uniform in projected solid angle of its disc), scattering for sky and
/// emission; the estimate is unbiased (Kajiya 1986). No decision needs a spectrum, only the highest factors of a
/// surface: what a path met is recorded, and PathLight makes radiance of it in all spectral nodes.
/// An object serves one thread.
class PathTracer {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  PathTracer(const SpectralScene& scene, TransportOptions options);

  /// The paths of rays from the sensor; the record holds until the next call. `first_hits` receives what each ray met.
  /// Adds shadow and bounce rays to `counts`.
  const PathRecord& trace(std::span<const math::Ray> rays, std::span<const PathKey> keys,
                          std::span<geometry::SurfacePoint> first_hits, sampling::RayCounts& counts);

 private:
  struct Path {
    math::Ray ray;
    PathKey key;
    std::uint32_t number = 0;  // in the record
    bool sees_sun = true;      // no next-event estimation was made for this segment
  };
  struct Scatter {  // a path that scatters at this depth
    std::uint32_t path = 0;
    std::uint32_t shadow = kNone;  // index of its shadow ray
    PathVertex vertex;             // sunlight as if nothing blocked it
    math::Ray next;
    bool next_sees_sun = false;
  };
  struct Sides;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  void trace_segment(sampling::RayCounts& counts, int depth);
  void advance(int depth, sampling::RayCounts& counts);
  void escape(const Path& path);
  PathVertex vertex_of(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe);
  /// What becomes of a path at a surface: an event is added, of no weights where it ends there without sunlight.
  void scatter(const Path& path, std::uint32_t path_index, const scene::ResolvedSurface& surface, int depth);
  void send_to_sun(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit, sampling::Point2 u,
                   Scatter& event);
  /// Direction, side and weight of the continued path, before any roulette; false where it ends.
  bool bounce(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit, sampling::Point2 u,
              Scatter& event) const;
  materials::ScatterSample sample_bounce(const materials::Scattering& scattering, math::Vec3 viewer, math::Normal3 lobe,
                                         bool bent, sampling::Point2 u) const;
  sampling::LightSample sample_sun(math::Vec3 normal, bool either_side, sampling::Point2 u) const;

  const SpectralScene& scene_;
  TransportOptions options_;
  std::optional<sampling::SolarDisc> disc_;
  const SkySampler* sky_ = nullptr;  // of a sky that is not uniform
  PathRecord record_;
  std::vector<Path> paths_, next_paths_;
  std::vector<math::Ray> rays_, shadow_rays_;
  std::vector<geometry::SurfacePoint> hits_;
  std::vector<Scatter> scatters_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace ifov::render
