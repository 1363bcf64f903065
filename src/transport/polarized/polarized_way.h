#pragma once

#include "radiometry/spectrum_block.h"
#include "transport/path_record.h"
#include "transport/polarized/polarized_beam.h"

namespace ifov::transport {

class SpectralScene;

/// Takes light along the ways by which it is sought: by mirrors, through panes and boundaries, which have a matrix each, and through
/// media, which take from all of it alike. An object serves one thread.
class PolarizedWay {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  explicit PolarizedWay(const SpectralScene& scene);

  /// In place: from the far end of a list of passes to its near one.
  void come_through(const PathRecord& record, std::uint32_t passes, PolarizedBeam& beam) {
    come_through(record, passes, PathVertex::kNone, beam);
  }
  /// In place: from the Sun, or an emitter, to the surface that it was sought from.
  void come_by(const PathRecord& record, const PathRecord::Mirrored& way, PolarizedBeam& beam);
  /// In place: what a medium leaves of light, and adds where it `shines`.
  void come_through(const PathRecord::Segment& segment, bool shines, PolarizedBeam& beam);

 private:
  /// As far as `last`, which is left out.
  void come_through(const PathRecord& record, std::uint32_t passes, std::uint32_t last, PolarizedBeam& beam);
  void meet(const PathRecord& record, const PathRecord::Mirrored::Factor& factor, bool transmitted,
            PolarizedBeam& beam);

  enum Work { kMatrix, kPart = kMatrix + 16, kLeft = kPart + 16, kBlack, kSpectra };
  const SpectralScene& scene_;
  std::size_t n_;
  radiometry::SpectrumBlock spectra_;
};

}  // namespace ifov::transport
