#pragma once

#include "radiometry/spectrum_block.h"
#include "transport/parts/light_part.h"
#include "transport/path_light.h"
#include "transport/view_atmosphere.h"

namespace ifov::transport {

/// The light of recorded paths as PathLight and ViewAtmosphere tell it, part by part. An object serves one thread.
class LightInParts : PathLight {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit LightInParts(const SpectralScene& scene);

  /// What a path's first surface makes of sunlight: what came through a pane came from there.
  static LightPart part_of_sunlight(const PathVertex& first) {
    return first.sun_passes == PathVertex::kNone ? LightPart::sun : LightPart::scene;
  }

  /// Of path k at the sensor, in nodes; the caller's until the next call.
  const PartRows& at_sensor(const PathRecord& record, std::size_t k);
  /// The same in two: what PathLight::levels() calls direct, with the air's own, and the rest. Where not `whole`, the latter is 0.
  struct Levels {
    const PartRows &direct, &rest;
  };
  Levels levels(const PathRecord& record, std::size_t k, bool whole);

 private:
  void clear(PartRows& rows);
  void start(const PathRecord& record, const PathRecord::Path& path, const PartRows& into, bool goes_on);
  void go_on(const PathRecord& record, const PathRecord::Path& path, const PartRows& into,
             OpenSky open_sky = OpenSky::both);
  void add_twins(const PathRecord& record, std::uint32_t also, const PartRows& into);
  /// What the first segment comes to that meets nothing.
  void add_seen_sky(const PathRecord::Path& path, const PartRows& into);
  void dim(const PathRecord::Path& path, const PartRows& rows) const;
  void add_air(const PathRecord::Path& path, const PartRows& rows) const;

  ViewAtmosphere air_;
  radiometry::SpectrumBlock direct_spectra_, rest_spectra_, surroundings_;
  PartRows direct_, rest_;
};

}  // namespace ifov::transport
