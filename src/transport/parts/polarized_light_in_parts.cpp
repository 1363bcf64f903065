#include "transport/parts/polarized_light_in_parts.h"

#include <algorithm>

#include "radiometry/polarization_frame.h"
#include "transport/parts/light_in_parts.h"
#include "transport/sky/surroundings_light.h"
#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"

namespace ifov::transport {

using radiometry::PolarizationFrame;

PolarizedLightInParts::PolarizedLightInParts(const SpectralScene& scene)
    : PolarizedPathLight(scene),
      air_(scene),
      polarized_air_(scene),
      spectra_of_parts_(4 * kRadianceParts + 1, scene.node_count()),
      surroundings_(3, scene.node_count()) {
  for (std::size_t p = 0; p < kRadianceParts; ++p)
    for (std::size_t c = 0; c < 4; ++c) parts_.radiance[p].row[c] = spectra_of_parts_.row(4 * p + c);
  parts_.transmittance = spectra_of_parts_.row(4 * kRadianceParts);
}

const PolarizedLightInParts::AtSensor& PolarizedLightInParts::at_sensor(const PathRecord& record,
                                                                        std::size_t k,
                                                                        const PolarizationFrame& frame) {
  for (const StokesRows& part : parts_.radiance)
    for (float* row : part.row) std::fill_n(row, n_, 0.0f);
  const PathRecord::Path& path = record.paths[k];
  add(record, path, frame);
  for (std::uint32_t also = path.also; also != PathVertex::kNone; also = record.paths[also].also)
    if (!record.paths[also].empty()) add(record, record.paths[also], frame);
  for (const LightPart part : {LightPart::emitted, LightPart::sun, LightPart::sky, LightPart::scene})
    polarized_air_.see_through(path, rows(part));
  polarized_air_.apply(path, frame, rows(LightPart::path));
  air_.transmittance(path, parts_.transmittance);
  return parts_;
}

void PolarizedLightInParts::add(const PathRecord& record, const PathRecord::Path& path,
                                const PolarizationFrame& frame) {
  list(record, path);
  if (vertices_.empty()) {
    if (path.escaped) add_seen_sky(record, path, frame);
    return;
  }
  const PathVertex& first = record.vertices[vertices_[0]];
  const Directions& directions = record.directions[vertices_[0]];
  clear_out(directions);
  emit(record, first);
  add_out(LightPart::emitted, frame);
  if (first.sun_weight > 0.0f) {
    clear_out(directions);
    add_sun(record, first, directions);
    add_out(LightInParts::part_of_sunlight(first), frame);
  }
  if (first.sought_weight > 0.0f || first.mirrored != PathVertex::kNone) {
    clear_out(directions);
    if (first.sought_weight > 0.0f) add_sought(record, first, directions);
    if (first.mirrored != PathVertex::kNone) add_mirrored(record, first, directions);
    add_out(LightPart::scene, frame);
  }
  if (!(first.continuation_weight > 0.0f)) return;
  const auto go_on = [&](LightPart part) {
    clear_out(directions);
    add_continuation(record, first, directions);
    add_out(part, frame);
  };
  if (vertices_.size() == 1) {
    if (!path.escaped) return;
    start(record, path, frame, true, false);
    go_on(path.escaped_direction.z >= 0.0 ? LightPart::sky : LightPart::scene);
    start(record, path, frame, false, true);
    go_on(LightPart::sun);
    return;
  }
  const PathVertex& second = record.vertices[vertices_[1]];
  start(record, path, frame, true, true);
  bring(record, 1);
  come_through(record, second, false, arriving_);
  go_on(LightPart::scene);
  if (second.segment == PathVertex::kNone) return;
  clear(arriving_, false);
  come_through(record, second, true, arriving_);
  go_on(LightPart::emitted);
}

void PolarizedLightInParts::add_seen_sky(const PathRecord& record, const PathRecord::Path& path,
                                         const PolarizationFrame& frame) {
  if (path.escaped_direction.z < 0.0) {
    constexpr LightPart kParts[] = {LightPart::emitted, LightPart::sun, LightPart::sky};
    if (const SurroundingsLight* around = scene_.surroundings_light()) {
      using Part = SurroundingsLight::Part;
      constexpr Part kTheirs[] = {Part::emitted, Part::sun, Part::sky};
      for (std::size_t p = 0; p < 3; ++p) {
        const auto& to = rows(kParts[p]);
        around->add(kTheirs[p], path.escaped_direction, &frame, {to[0], to[1], to[2]});
      }
      return;
    }
    scene_.split_surroundings(path.escaped_direction, surroundings_.row(0), surroundings_.row(1),
                              surroundings_.row(2));
    for (std::size_t p = 0; p < 3; ++p)
      spectra::add_scaled(rows(kParts[p])[0], surroundings_.row(p), 1.0f, n_);
  } else {
    start(record, path, frame, true, false);
    add_rows(LightPart::path, about(arriving_, frame));
  }
  start(record, path, frame, false, true);
  add_rows(LightPart::sun, about(arriving_, frame));
}

void PolarizedLightInParts::clear_out(const Directions& directions) {
  clear(out_, false);
  out_.frame = radiometry::surface_frame(directions.outgoing, directions.normal);
}

void PolarizedLightInParts::add_out(LightPart part, const PolarizationFrame& frame) {
  add_rows(part, about(out_, frame));
}

void PolarizedLightInParts::add_rows(LightPart part, const StokesRows& light) {
  for (std::size_t c = 0; c < 4; ++c) spectra::add_scaled(rows(part)[c], light[c], 1.0f, n_);
}

}  // namespace ifov::transport
