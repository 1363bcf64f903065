#include "transport/polarized/polarized_way.h"

#include <algorithm>
#include <cmath>

#include "scene/scene.h"
#include "transport/polarized/lobe_mueller.h"
#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"

namespace ifov::transport {
namespace {

using materials::BsdfEvent;
using materials::MuellerRows;
using math::Vec3;

/// Of a surface on the way to a light: its event as light that goes the other way meets it. A mirror is kept as seen from where
/// the light comes from; of what light goes through straight on no incoming direction is kept.
BsdfEvent met_by_light(const BsdfEvent& kept, bool transmitted) {
  BsdfEvent event = kept;
  if (!transmitted) {
    const Vec3 normal = kept.normal.as_vector();
    event.incoming = kept.outgoing;
    event.outgoing = math::normalized(2.0 * math::dot(normal, kept.outgoing) * normal - kept.outgoing);
  } else if (!(math::dot(kept.incoming, kept.incoming) > 0.0)) {
    event.incoming = -kept.outgoing;
  }
  return event;
}

/// beam = matrix beam, about the surface's frames.
void multiply(const MuellerRows& matrix, const BsdfEvent& event, std::size_t n, PolarizedBeam& beam) {
  const Vec3 normal = event.normal.as_vector();
  const StokesRows& light = beam.rows;
  if (beam.polarized) {
    FrameTurn(beam.frame, radiometry::surface_frame(-event.incoming, normal)).apply(light, n);
    for (std::size_t k = 0; k < n; ++k) {
      const float before[4] = {light[0][k], light[1][k], light[2][k], light[3][k]};
      for (std::size_t r = 0; r < 4; ++r) {
        float sum = 0.0f;
        for (std::size_t c = 0; c < 4; ++c) sum += matrix.at(r, c)[k] * before[c];
        light[r][k] = sum;
      }
    }
  } else {
    for (std::size_t k = 0; k < n; ++k) {
      const float before = light[0][k];
      for (std::size_t r = 0; r < 4; ++r) light[r][k] = matrix.at(r, 0)[k] * before;
    }
  }
  beam.polarized = true;
  beam.frame = radiometry::surface_frame(event.outgoing, normal);
}

}  // namespace

PolarizedWay::PolarizedWay(const SpectralScene& scene) : scene_(scene), n_(scene.stride()) {
  spectra_.resize(kSpectra, scene.node_count());
}

void PolarizedWay::come_through(const PathRecord::Segment& segment, bool shines, PolarizedBeam& beam) {
  const float* __restrict per_m = scene_.absorption(segment.medium.material);
  float* __restrict left = spectra_.row(kLeft);
  const float length = static_cast<float>(segment.length_m);
  for (std::size_t k = 0; k < n_; ++k) left[k] = std::exp(-per_m[k] * length);
  for (std::size_t c = 0; c < (beam.polarized ? 4u : 1u); ++c) spectra::scale(beam.rows[c], left, n_);
  const float* black = shines ? scene_.black(segment.medium, spectra_.row(kBlack)) : nullptr;
  if (black == nullptr) return;
  float* __restrict whole = beam.rows[0];
  for (std::size_t k = 0; k < n_; ++k) whole[k] += (1.0f - left[k]) * black[k];
}

void PolarizedWay::come_through(const PathRecord& record, std::uint32_t passes, std::uint32_t last,
                                PolarizedBeam& beam) {
  for (std::uint32_t k = passes; k != last && k != PathVertex::kNone; k = record.passes[k].next) {
    const PathRecord::Pass& pass = record.passes[k];
    if (pass.segment != PathVertex::kNone)
      come_through(record.segments[pass.segment], false, beam);
    else
      meet(record, pass.factor, true, beam);
  }
}

void PolarizedWay::come_by(const PathRecord& record, const PathRecord::Mirrored& way, PolarizedBeam& beam) {
  std::uint32_t passes = way.passes;
  for (std::size_t m = way.count; m-- > 0;) {
    come_through(record, passes, way.passes_at[m], beam);
    passes = way.passes_at[m];
    meet(record, way.mirrors[m], false, beam);
  }
  come_through(record, passes, beam);
}

void PolarizedWay::meet(const PathRecord& record, const PathRecord::Mirrored::Factor& factor,
                        bool transmitted, PolarizedBeam& beam) {
  const PathRecord::Mixed& mixed = record.mixed[factor.mixed];
  const BsdfEvent event = met_by_light(record.way_events[factor.event].event, transmitted);
  const MuellerRows matrix{spectra_.row(kMatrix), n_, beam.polarized};
  lobe_mueller(scene_, mixed.surface, mixed.lobe, event, matrix, spectra_.row(kPart));
  multiply(matrix, event, n_, beam);
}

}  // namespace ifov::transport
