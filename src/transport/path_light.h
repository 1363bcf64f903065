#pragma once

#include "radiometry/spectrum_block.h"
#include "transport/path_record.h"

namespace ifov::transport {

class SpectralScene;

/// The light of recorded paths, one whole path after the other: its own spectra stay in the first-level cache.
/// An object serves one thread.
class PathLight {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit PathLight(const SpectralScene& scene);

  /// Radiance that path k brings to where its first segment ends, in nodes: what the surface there sends, or the sky,
  /// before the air of that segment (ViewAtmosphere). The spectrum is the caller's until the next call.
  float* radiance(const PathRecord& record, std::size_t k);
  /// The same in two parts: what the first surface emits and sends of light that it was sent for (the Sun's, that of emitters, also
  /// by way of mirrors) and of the open sky's integral, or the sky itself; and the rest, which comes by the path that goes on from
  /// there. `rest` is null where only the first is asked for, which a path needs not to be traced whole for.
  struct Levels {
    float* direct;
    float* rest;
  };
  Levels levels(const PathRecord& record, std::size_t k, bool whole);
  /// Of that, what the first surface makes of direct sunlight.
  float* first_sunlight(const PathRecord& record, std::size_t k);
  /// Adds what radiance() has of TransportOptions::sky_shares, which PolarizedPathLight leaves out. Keeps the spectra that
  /// levels() gave.
  void add_open_sky(const PathRecord& record, std::size_t k, float* to);

 protected:
  enum Work {
    kSum,
    kThroughput,
    kEmission,
    kEmissionPart,
    kEmissionWork,
    kSunFactor,
    kContinuationFactor,
    kSun,
    kSkyShare,
    kDimmed,
    kSoughtFactor,
    kMirrored,
    kSunlight,
    kSoughtLight,
    kSegment,
    kBlack,
    kWhole,
    kDirect,
    kOpenSky,
    kWork,
    kMoreWork,
    kSpectra
  };
  float* spectrum(Work w) { return spectra_.row(w); }
  const float* open_sky(math::Vec3 normal);
  /// What the first surface makes of the open sky, less what it makes of it in the direction that was drawn: 0 in the mean. Or either.
  enum class OpenSky : std::uint8_t { both, integral, drawn };
  void add_open_sky(const PathRecord& record, const PathRecord::Path& path, const PathVertex& vertex,
                    OpenSky which = OpenSky::both);
  void add_first(const PathRecord& record, const PathVertex& vertex, bool goes_on = true);
  void add_later(const PathRecord& record, const PathVertex& vertex);
  const float* emission(const PathRecord& record, const PathVertex& vertex);
  const float* emission(const PathRecord::Mixed& mixed);
  static bool is_directional(const PathRecord& record, const PathVertex& vertex) {
    return vertex.mixed != PathVertex::kNone && record.mixed[vertex.mixed].events != PathVertex::kNone;
  }
  const float* sun_factor(const PathRecord& record, const PathVertex& vertex);
  /// `sun` the vertex's sun_factor() if that is known, else null.
  const float* continuation_factor(const PathRecord& record, const PathVertex& vertex, const float* sun);
  void add_sought(const PathRecord& record, const PathVertex& vertex, const float* throughput);
  /// What a path's last segment brings that met nothing: of the sky or the ground beyond the scene, and of the Sun's disc.
  void add_escaped(const PathRecord::Path& path);
  void add_sky(const PathRecord::Path& path);
  void add_disc(const PathRecord::Path& path);
  /// The sky's light on its way to a path's surfaces, for the ground about them (AdjacentGround).
  void brighten(const PathRecord::Path& path, float* light) const;
  /// One path alone, without those that began as it.
  void one(const PathRecord& record, std::size_t k);
  /// Of one path, after its first surface: later ones and where it ends.
  void later(const PathRecord& record, const PathRecord::Path& path, OpenSky open_sky = OpenSky::both);
  /// The Sun's irradiance at a vertex, through what it comes through.
  const float* sunlight(const PathRecord& record, const PathVertex& vertex);
  /// Multiplies by what a chain of PathRecord::passes leaves.
  void dim(const PathRecord& record, std::uint32_t passes, float* light);
  const float* factor(const PathRecord& record, const PathRecord::Mirrored::Factor& factor, bool transmitted);
  /// What a medium leaves of light over its length.
  const float* left_by(const PathRecord::Segment& segment);
  void come_through(const PathRecord::Segment& segment, bool shines);
  /// Through the medium, if any, before a surface that is not the path's first.
  void come_to(const PathRecord& record, const PathVertex& vertex) {
    if (vertex.segment != PathVertex::kNone)
      come_through(record.segments[vertex.segment], vertex.segment_shines);
  }
  /// Sunlight by way of mirrors; `throughput` null: 1.
  void add_mirrored(const PathRecord& record, const PathVertex& vertex, const float* throughput);

  const SpectralScene& scene_;
  std::size_t n_;
  math::Vec3 open_sky_normal_{};  // of spectrum(kOpenSky), the open sky's irradiance; 0: of none yet
  radiometry::SpectrumBlock spectra_;
  float* sum_ = nullptr;  // that light is added to; else spectrum(kSum)
};

}  // namespace ifov::transport
