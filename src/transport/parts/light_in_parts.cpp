#include "transport/parts/light_in_parts.h"

#include <algorithm>

#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"

namespace ifov::transport {

LightInParts::LightInParts(const SpectralScene& scene)
    : PathLight(scene),
      air_(scene),
      direct_spectra_(kLightParts, scene.node_count()),
      rest_spectra_(kLightParts, scene.node_count()),
      surroundings_(3, scene.node_count()) {
  for (std::size_t p = 0; p < kLightParts; ++p) {
    direct_.row[p] = direct_spectra_.row(p);
    rest_.row[p] = rest_spectra_.row(p);
  }
}

const PartRows& LightInParts::at_sensor(const PathRecord& record, std::size_t k) {
  const PathRecord::Path& path = record.paths[k];
  clear(direct_);
  start(record, path, direct_, true);
  go_on(record, path, direct_);
  add_twins(record, path.also, direct_);
  dim(path, direct_);
  add_air(path, direct_);
  return direct_;
}

LightInParts::Levels LightInParts::levels(const PathRecord& record, std::size_t k, bool whole) {
  const PathRecord::Path& path = record.paths[k];
  clear(direct_);
  clear(rest_);
  start(record, path, direct_, whole);
  if (path.first == PathVertex::kNone) {
    go_on(record, path, direct_);
  } else if (path.sky_share > 0.0f) {
    sum_ = direct_[LightPart::sky];
    add_open_sky(record, path, record.vertices[path.first], OpenSky::integral);
  }
  if (whole) {
    if (path.first != PathVertex::kNone) go_on(record, path, rest_, OpenSky::drawn);
    add_twins(record, path.also, rest_);
    dim(path, rest_);
  }
  dim(path, direct_);
  add_air(path, direct_);
  return {direct_, rest_};
}

void LightInParts::clear(PartRows& rows) {
  for (float* row : rows.row) std::fill_n(row, n_, 0.0f);
}

void LightInParts::start(const PathRecord& record, const PathRecord::Path& path, const PartRows& into,
                         bool goes_on) {
  if (path.first == PathVertex::kNone) return;
  const PathVertex& vertex = record.vertices[path.first];
  if (vertex.emission_weight > 0.0f)
    if (const float* emitted = emission(record, vertex))
      spectra::add_scaled(into[LightPart::emitted], emitted, 1.0f, n_);
  const float* factor = nullptr;
  if (vertex.sun_weight > 0.0f) {
    factor = sun_factor(record, vertex);
    spectra::add_scaled_product(into[part_of_sunlight(vertex)], factor, sunlight(record, vertex),
                                vertex.sun_weight, n_);
  }
  sum_ = into[LightPart::scene];
  if (vertex.sought_weight > 0.0f) add_sought(record, vertex, nullptr);
  if (vertex.mirrored != PathVertex::kNone) add_mirrored(record, vertex, nullptr);
  if (goes_on && vertex.continuation_weight > 0.0f)
    spectra::set_scaled(spectrum(kThroughput), continuation_factor(record, vertex, factor),
                        vertex.continuation_weight, n_);
}

void LightInParts::go_on(const PathRecord& record, const PathRecord::Path& path, const PartRows& into,
                         OpenSky open_sky) {
  if (path.first == PathVertex::kNone) {
    if (path.escaped) add_seen_sky(path, into);
    return;
  }
  sum_ = into[LightPart::sky];
  if (path.sky_share > 0.0f) add_open_sky(record, path, record.vertices[path.first], open_sky);
  const std::uint32_t second = record.vertices[path.first].next;
  for (std::uint32_t k = second; k != PathVertex::kNone; k = record.vertices[k].next) {
    sum_ = into[k == second ? LightPart::emitted : LightPart::scene];
    come_to(record, record.vertices[k]);
    sum_ = into[LightPart::scene];
    add_later(record, record.vertices[k]);
  }
  if (!path.escaped) return;
  const bool straight = second == PathVertex::kNone;
  sum_ = into[straight && path.escaped_direction.z >= 0.0 ? LightPart::sky : LightPart::scene];
  add_sky(path);
  sum_ = into[straight ? LightPart::sun : LightPart::scene];
  add_disc(path);
}

void LightInParts::add_twins(const PathRecord& record, std::uint32_t also, const PartRows& into) {
  for (; also != PathVertex::kNone; also = record.paths[also].also) {
    const PathRecord::Path& twin = record.paths[also];
    if (twin.empty()) continue;
    start(record, twin, into, true);
    go_on(record, twin, into);
  }
}

void LightInParts::add_seen_sky(const PathRecord::Path& path, const PartRows& into) {
  if (path.escaped_direction.z < 0.0) {
    constexpr LightPart kParts[] = {LightPart::emitted, LightPart::sun, LightPart::sky};
    scene_.split_surroundings(path.escaped_direction, surroundings_.row(0), surroundings_.row(1),
                              surroundings_.row(2));
    for (std::size_t p = 0; p < 3; ++p) spectra::add_scaled(into[kParts[p]], surroundings_.row(p), 1.0f, n_);
  } else {
    sum_ = into[LightPart::path];
    add_sky(path);
  }
  sum_ = into[LightPart::sun];
  add_disc(path);
}

void LightInParts::dim(const PathRecord::Path& path, const PartRows& rows) const {
  for (const LightPart part : {LightPart::emitted, LightPart::sun, LightPart::sky, LightPart::scene})
    air_.dim(path, rows[part]);
}

void LightInParts::add_air(const PathRecord::Path& path, const PartRows& rows) const {
  air_.apply(path, rows[LightPart::path]);
  air_.transmittance(path, rows[LightPart::transmittance]);
}

}  // namespace ifov::transport
