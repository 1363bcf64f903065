#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "materials/scattering.h"
#include "math/ray.h"
#include "render/spectral_scene.h"
#include "render/surface_rows.h"
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

/// A spectral path tracer, breadth first: a batch of paths advances together, one bounce at a time, so that the ray
/// tracer sees large batches, and every path carries all spectral nodes. Next-event estimation to the Sun (uniform
/// in projected solid angle of its disc), scattering for sky and emission; the estimate is unbiased (Kajiya 1986).
/// An object serves one thread.
class PathTracer {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  PathTracer(const SpectralScene& scene, TransportOptions options);

  /// Radiance along each ray towards its origin, at the sensor (view path included), in nodes: row k of `radiance`
  /// (resized here). `first_hits` receives what each ray met. Adds shadow and bounce rays to `counts`.
  void trace(std::span<const math::Ray> rays, std::span<const PathKey> keys, radiometry::SpectrumBlock& radiance,
             std::span<geometry::SurfacePoint> first_hits, sampling::RayCounts& counts);

 private:
  struct Path {
    math::Ray ray;
    PathKey key;
    std::uint32_t row = 0;         // of the radiance block
    std::uint32_t throughput = 0;  // row of the throughput block
    bool sees_sun = true;          // no next-event estimation was made for this segment
  };
  struct Scatter {                 // a path that scatters at this depth
    std::uint32_t path = 0;
    std::uint32_t shadow = kNone;  // index of its shadow ray
    const float* sun_factor = nullptr;     // spectral factors of sunlight and of the continued path
    const float* bounce_factor = nullptr;
    float sun_weight = 0.0f;       // of sun_irradiance, before visibility
    float bounce_weight = 0.0f;    // of the factor, in the continued path; 0 ends it
    math::Ray next;
    bool next_sees_sun = false;
    const float* emission = nullptr;  // not yet written to the path's radiance
  };
  struct Sides;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// Paths advance in groups small enough that their rows stay in the second-level cache.
  static constexpr std::size_t kGroup = 256;

  void trace_segment(sampling::RayCounts& counts, int depth);
  void advance(int depth, radiometry::SpectrumBlock& radiance, sampling::RayCounts& counts);
  void add_escaped(const Path& path, int depth, float* radiance);
  /// Whether the path scatters: an event was added.
  bool scatter(const Path& path, std::uint32_t path_index, const scene::ResolvedSurface& surface, int depth);
  void send_to_sun(const SurfaceRows& rows, const Sides& sides, const geometry::SurfacePoint& hit, sampling::Point2 u,
                   Scatter& event);
  /// Direction, factor and weight of the continued path, before any roulette; false where it ends.
  bool bounce(const SurfaceRows& rows, const Sides& sides, const geometry::SurfacePoint& hit, sampling::Point2 u,
              Scatter& event) const;
  materials::ScatterSample sample_bounce(const materials::Scattering& scattering, math::Vec3 viewer, math::Normal3 lobe,
                                         bool bent, sampling::Point2 u) const;
  sampling::LightSample sample_sun(math::Vec3 normal, bool either_side, sampling::Point2 u) const;

  const SpectralScene& scene_;
  TransportOptions options_;
  std::size_t row_floats_;
  std::optional<sampling::SolarDisc> disc_;
  const SkySampler* sky_ = nullptr;  // of a sky that is not uniform
  radiometry::SpectrumBlock throughput_;
  radiometry::SpectrumBlock scratch_;  // of emission
  radiometry::SpectrumBlock blends_;   // two rows for each path of a group; empty without blends
  std::vector<Path> paths_, next_paths_;
  std::vector<math::Ray> rays_, shadow_rays_;
  std::vector<geometry::SurfacePoint> hits_;
  std::vector<Scatter> scatters_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace ifov::render
