#pragma once

#include <vector>

#include "radiometry/spectrum_block.h"
#include "transport/path_record.h"
#include "transport/polarized/polarized_beam.h"
#include "transport/polarized/polarized_way.h"

namespace ifov::materials {
struct MuellerRows;
}

namespace ifov::transport {

class SpectralScene;

/// As PathLight, with the polarization of light: a path is walked from its far end to the sensor, a Stokes vector in hand, so that
/// each surface costs one matrix times one vector, and one that depolarizes no more than its factor. Of a scene that
/// is polarized(), whose paths keep their directions. An object serves one thread.
class PolarizedPathLight {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit PolarizedPathLight(const SpectralScene& scene);

  /// The light that path k brings to where its first segment ends, as PathLight::radiance(), about a frame of
  /// the direction towards the sensor. The spectra are the caller's until the next call.
  StokesRows light(const PathRecord& record, std::size_t k, const radiometry::PolarizationFrame& frame);
  /// Of that, what the first surface makes of direct sunlight.
  StokesRows first_sunlight(const PathRecord& record, std::size_t k,
                            const radiometry::PolarizationFrame& frame);

 protected:
  enum Work {
    kOut,
    kArriving = kOut + 4,
    kSource = kArriving + 4,
    kTurned = kSource + 4,
    kMueller = kTurned + 4,
    kMuellerWork = kMueller + 16,
    kEmission = kMuellerWork + 16,
    kEmissionPart,
    kEmissionWork,
    kFactor,
    kWork,
    kMoreWork,
    kSun,
    kWhole,
    kSpectra = kWhole + 4
  };
  using Beam = PolarizedBeam;
  using Directions = PathRecord::Directions;

  float* spectrum(int w) { return spectra_.row(static_cast<std::size_t>(w)); }
  StokesRows rows_from(int w) { return {{spectrum(w), spectrum(w + 1), spectrum(w + 2), spectrum(w + 3)}}; }
  StokesRows one(const PathRecord& record, std::size_t k, const radiometry::PolarizationFrame& frame);
  /// Leaves in `vertices_` those of a path.
  void list(const PathRecord& record, const PathRecord::Path& path);
  /// What its far end sends, into `arriving_`: of the sky, or of the Sun's disc, or of both. `frame` is of who sees it where it met
  /// nothing.
  void start(const PathRecord& record, const PathRecord::Path& path,
             const radiometry::PolarizationFrame& frame, bool sky, bool disc);
  /// Takes `arriving_` from there to where the segment behind the vertex of that number begins; the medium of that is left out.
  void bring(const PathRecord& record, std::size_t vertex);
  StokesRows about(Beam& beam, const radiometry::PolarizationFrame& frame);
  void clear(Beam& beam, bool polarized);
  void polarize(Beam& beam);

  void start_at_sky(const PathRecord::Path& path, const radiometry::PolarizationFrame* frame);
  void add_disc(const PathRecord::Path& path);
  /// What leaves a vertex; `arriving_` is what its continuation brings.
  void leave(const PathRecord& record, const PathVertex& vertex, const Directions& directions);
  /// What then becomes of it in the medium that the path came through.
  void come_through(const PathRecord& record, const PathVertex& vertex, bool shines, PolarizedBeam& light) {
    if (vertex.segment != PathVertex::kNone)
      way_.come_through(record.segments[vertex.segment], shines && vertex.segment_shines, light);
  }
  void emit(const PathRecord& record, const PathVertex& vertex);
  void add_sun(const PathRecord& record, const PathVertex& vertex, const Directions& directions);
  void add_sought(const PathRecord& record, const PathVertex& vertex, const Directions& directions);
  void add_mirrored(const PathRecord& record, const PathVertex& vertex, const Directions& directions);
  void add_continuation(const PathRecord& record, const PathVertex& vertex, const Directions& directions);
  /// Emission of a surface whose spectra are not kept, towards where it was met from; false where there is none.
  bool emit(const PathRecord::Mixed& mixed, Beam& beam);
  const float* factor(const PathRecord& record, std::uint32_t mixed, const float* kept, bool transmitted,
                      const LobeEvent* event);
  /// Adds what a surface that polarizes makes of light from both directions of an event.
  void add_scattered(const PathRecord::Mixed& mixed, const LobeEvent& event, const Beam& light, float weight);
  void add_times(const materials::MuellerRows& matrix, const Beam& light, const materials::BsdfEvent& event,
                 float weight);
  void add_unpolarized(const float* factor, const float* light, float weight);

  const SpectralScene& scene_;
  std::size_t n_;
  radiometry::SpectrumBlock spectra_;
  Beam out_, arriving_, source_;
  PolarizedWay way_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace ifov::transport
