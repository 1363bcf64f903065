#pragma once

#include "radiometry/spectrum_block.h"
#include "render/path_record.h"
#include "render/spectral_scene.h"

namespace ifov::render {

/// The light of recorded paths, one whole path after the other: its own rows stay in the first-level cache.
/// An object serves one thread.
class PathLight {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit PathLight(const SpectralScene& scene);

  /// Radiance of path k at the sensor, view path included, in nodes. The row holds until the next call.
  const float* radiance(const PathRecord& record, std::size_t k);

 private:
  enum Row { kSum, kThroughput, kEmission, kEmissionPart, kSunFactor, kBounceFactor, kSun, kSkyShare, kDimmed,
             kSoughtFactor, kWay, kRows };
  float* row(Row r) { return rows_.row(r); }
  void add_first(const PathRecord& record, const PathVertex& vertex);
  void add_later(const PathRecord& record, const PathVertex& vertex);
  const float* emission(const PathRecord& record, const PathVertex& vertex);
  const float* sun_factor(const PathRecord& record, const PathVertex& vertex);
  /// `sun` the vertex's sun_factor() if that is known, else null.
  const float* bounce_factor(const PathRecord& record, const PathVertex& vertex, const float* sun);
  void add_sought(const PathRecord& record, const PathVertex& vertex, const float* throughput);
  void add_escaped(const PathRecord::Path& path);
  /// Sunlight by way of mirrors; `throughput` null: 1.
  void add_mirrored(const PathRecord& record, const PathVertex& vertex, const float* throughput);
  void see_through_air(const PathRecord::Path& path);

  const SpectralScene& scene_;
  std::size_t n_;
  radiometry::SpectrumBlock rows_;
};

}  // namespace ifov::render
