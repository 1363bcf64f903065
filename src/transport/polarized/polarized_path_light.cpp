#include "transport/polarized/polarized_path_light.h"

#include <algorithm>
#include <cmath>

#include "transport/mirrors/sun_disc.h"
#include "transport/polarized/lobe_mueller.h"
#include "transport/sky/adjacent_ground.h"
#include "transport/sky/sky_dome.h"
#include "transport/sky/surroundings_light.h"
#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"

namespace ifov::transport {

using math::Vec3;
using radiometry::PolarizationFrame;

namespace {

/// Light that a plane mirror turns from one direction of propagation into another: U and V change their signs in the plane of
/// both (r_p = -r_s). Returns the frame that it is about then.
PolarizationFrame reflect(const PolarizationFrame& frame, Vec3 onward, const StokesRows& light,
                          std::size_t n) {
  const radiometry::ScatteringFrames plane = radiometry::scattering_frames(frame.direction, onward);
  FrameTurn(frame, plane.before).apply(light, n);
  for (std::size_t i = 0; i < n; ++i) {
    light[2][i] = -light[2][i];
    light[3][i] = -light[3][i];
  }
  return plane.after;
}

}  // namespace

PolarizedPathLight::PolarizedPathLight(const SpectralScene& scene)
    : scene_(scene), n_(scene.stride()), way_(scene) {
  static_assert(kMoreWork == kWork + 1 && kEmissionPart == kEmission + 1 && kEmissionWork == kEmission + 2);
  spectra_.resize(kSpectra, scene.node_count());
  out_.rows = rows_from(kOut);
  arriving_.rows = rows_from(kArriving);
  source_.rows = rows_from(kSource);
}

void PolarizedPathLight::clear(Beam& beam, bool polarized) {
  for (std::size_t c = 0; c < (polarized ? 4u : 1u); ++c) std::fill_n(beam.rows[c], n_, 0.0f);
  beam.polarized = polarized;
  beam.any = false;
}

void PolarizedPathLight::polarize(Beam& beam) {
  if (beam.polarized) return;
  for (std::size_t c = 1; c < 4; ++c) std::fill_n(beam.rows[c], n_, 0.0f);
  beam.polarized = true;
}

StokesRows PolarizedPathLight::about(Beam& beam, const PolarizationFrame& frame) {
  if (beam.polarized)
    FrameTurn(beam.frame, frame).apply(beam.rows, n_);
  else
    polarize(beam);
  return beam.rows;
}

StokesRows PolarizedPathLight::light(const PathRecord& record, std::size_t k,
                                     const PolarizationFrame& frame) {
  std::uint32_t also = record.paths[k].also;
  const StokesRows first = one(record, k, frame);
  if (also == PathVertex::kNone) return first;
  const StokesRows whole = rows_from(kWhole);
  for (std::size_t c = 0; c < 4; ++c) std::copy_n(first[c], n_, whole[c]);
  for (; also != PathVertex::kNone; also = record.paths[also].also) {
    if (record.paths[also].empty()) continue;
    const StokesRows more = one(record, also, frame);
    for (std::size_t c = 0; c < 4; ++c) spectra::add_scaled(whole[c], more[c], 1.0f, n_);
  }
  return whole;
}

StokesRows PolarizedPathLight::one(const PathRecord& record, std::size_t k, const PolarizationFrame& frame) {
  const PathRecord::Path& path = record.paths[k];
  list(record, path);
  start(record, path, frame, true, true);
  if (vertices_.empty()) return about(arriving_, frame);
  bring(record, 0);
  come_through(record, record.vertices[path.first], true, arriving_);
  return about(arriving_, frame);
}

void PolarizedPathLight::list(const PathRecord& record, const PathRecord::Path& path) {
  vertices_.clear();
  for (std::uint32_t v = path.first; v != PathVertex::kNone; v = record.vertices[v].next)
    vertices_.push_back(v);
}

void PolarizedPathLight::start(const PathRecord& record, const PathRecord::Path& path,
                               const PolarizationFrame& frame, bool sky, bool disc) {
  clear(arriving_, false);
  if (!path.escaped) return;
  arriving_.any = true;
  PolarizationFrame sky_frame = frame;
  bool kept = vertices_.empty();
  if (!kept) {
    const Directions& last = record.directions[vertices_.back()];
    kept = last.polarizing != nullptr;
    if (kept) sky_frame = radiometry::surface_frame(-path.escaped_direction, last.normal);
  }
  if (sky) start_at_sky(path, kept ? &sky_frame : nullptr);
  if (disc) add_disc(path);
}

void PolarizedPathLight::bring(const PathRecord& record, std::size_t vertex) {
  for (std::size_t at = vertices_.size(); at-- > vertex;) {
    const PathVertex& here = record.vertices[vertices_[at]];
    leave(record, here, record.directions[vertices_[at]]);
    if (at > vertex) come_through(record, here, true, out_);
    std::swap(out_, arriving_);
  }
}

StokesRows PolarizedPathLight::first_sunlight(const PathRecord& record, std::size_t k,
                                              const PolarizationFrame& frame) {
  clear(out_, true);
  const std::uint32_t first = record.paths[k].first;
  if (first == PathVertex::kNone || record.vertices[first].sun_weight <= 0.0f) return out_.rows;
  const Directions& directions = record.directions[first];
  out_.frame = radiometry::surface_frame(directions.outgoing, directions.normal);
  add_sun(record, record.vertices[first], directions);
  return about(out_, frame);
}

/// `frame` null: the intensity alone counts.
void PolarizedPathLight::start_at_sky(const PathRecord::Path& path, const PolarizationFrame* frame) {
  const Vec3 direction = path.escaped_direction;
  const SkyDome* dome = scene_.sky_dome();
  const SurroundingsLight* around = direction.z < 0.0 ? scene_.surroundings_light() : nullptr;
  if (around != nullptr) {
    std::fill_n(arriving_.rows[0], n_, 0.0f);
    if (frame != nullptr) {
      arriving_.polarized = true;
      arriving_.frame = *frame;
      for (std::size_t c = 1; c < 4; ++c) std::fill_n(arriving_.rows[c], n_, 0.0f);
    }
    around->add_all(direction, frame, {arriving_.rows[0], arriving_.rows[1], arriving_.rows[2]});
  } else if (dome == nullptr || direction.z < 0.0) {
    std::copy_n(direction.z < 0.0 ? scene_.surroundings_radiance() : scene_.sky_radiance(), n_,
                arriving_.rows[0]);
  } else {
    const SkyDome::Corners corners = dome->at(direction);
    spectra::sum_of_scaled(arriving_.rows[0], corners.spectrum.data(), corners.weight.data(), n_);
    if (frame != nullptr && dome->polarized()) {
      const SkyDome::PolarizedCorners sky = dome->polarization(corners, direction, *frame);
      arriving_.polarized = true;
      arriving_.frame = *frame;
      float* __restrict q = arriving_.rows[1], * __restrict u = arriving_.rows[2];
      std::fill_n(q, n_, 0.0f);
      std::fill_n(u, n_, 0.0f);
      std::fill_n(arriving_.rows[3], n_, 0.0f);
      for (std::size_t k = 0; k < sky.q.size(); ++k) {
        const float c = sky.cosine[k], s = sky.sine[k], side = sky.side;
        const float* __restrict from_q = sky.q[k], * __restrict from_u = sky.u[k];
        for (std::size_t i = 0; i < n_; ++i) {
          q[i] += c * from_q[i] + s * (side * from_u[i]);
          u[i] += c * (side * from_u[i]) - s * from_q[i];
        }
      }
    }
    if (path.first != PathVertex::kNone && scene_.light_by_height()) {
      const float* share = scene_.sky_share(path.escaped_from_m, spectrum(kWork));
      for (std::size_t c = 0; c < (arriving_.polarized ? 3u : 1u); ++c)
        spectra::scale(arriving_.rows[c], share, n_);
    }
    if (const AdjacentGround* adjacent = scene_.adjacent_ground();
        adjacent != nullptr && path.first != PathVertex::kNone)
      adjacent->brighten(path.seen_x_m, path.seen_y_m,
                         arriving_.rows[0]);  // what the ground adds is unpolarized
  }
}

void PolarizedPathLight::add_disc(const PathRecord::Path& path) {
  if (!path.escaped_sees_sun) return;
  const auto per_irradiance = static_cast<float>(sun_disc_radiance(scene_.scene(), path.escaped_direction));
  if (per_irradiance > 0.0f)
    spectra::add_scaled(arriving_.rows[0], scene_.sun_irradiance(), per_irradiance, n_);
}

void PolarizedPathLight::leave(const PathRecord& record, const PathVertex& vertex,
                               const Directions& directions) {
  out_.frame = radiometry::surface_frame(directions.outgoing, directions.normal);
  emit(record, vertex);
  if (vertex.sun_weight > 0.0f) add_sun(record, vertex, directions);
  if (vertex.sought_weight > 0.0f) add_sought(record, vertex, directions);
  if (vertex.mirrored != PathVertex::kNone) add_mirrored(record, vertex, directions);
  if (vertex.continuation_weight > 0.0f && arriving_.any) add_continuation(record, vertex, directions);
  out_.any = true;
}

void PolarizedPathLight::emit(const PathRecord& record, const PathVertex& vertex) {
  out_.polarized = false;
  const float weight = vertex.emission_weight;
  if (!(weight > 0.0f)) {
    std::fill_n(out_.rows[0], n_, 0.0f);
    return;
  }
  if (vertex.mixed == PathVertex::kNone) {
    if (vertex.emission == nullptr)
      std::fill_n(out_.rows[0], n_, 0.0f);
    else
      spectra::set_scaled(out_.rows[0], vertex.emission, weight, n_);
    return;
  }
  const PolarizationFrame frame = out_.frame;
  if (!emit(record.mixed[vertex.mixed], out_)) {
    std::fill_n(out_.rows[0], n_, 0.0f);
    return;
  }
  if (out_.polarized) FrameTurn(out_.frame, frame).apply(out_.rows, n_);
  out_.frame = frame;
  if (weight == 1.0f) return;
  for (std::size_t c = 0; c < (out_.polarized ? 2u : 1u); ++c)
    for (std::size_t i = 0; i < n_; ++i) out_.rows[c][i] *= weight;
}

bool PolarizedPathLight::emit(const PathRecord::Mixed& mixed, Beam& beam) {
  beam.polarized = false;
  const float* whole = scene_.emission(mixed.surface, mixed.outgoing, spectrum(kEmission));
  if (whole == nullptr) return false;
  std::copy_n(whole, n_, beam.rows[0]);
  beam.frame = radiometry::surface_frame(mixed.outgoing, mixed.surface.shading_normal.as_vector());
  if (scene_.emission_q(mixed.surface, mixed.outgoing, spectrum(kEmission))) {
    polarize(beam);
    std::copy_n(spectrum(kEmission), n_, beam.rows[1]);
  }
  return true;
}

const float* PolarizedPathLight::factor(const PathRecord& record, std::uint32_t mixed, const float* kept,
                                        bool transmitted, const LobeEvent* event) {
  if (mixed == PathVertex::kNone || kept != nullptr) return kept;
  const PathRecord::Mixed& of = record.mixed[mixed];
  return lobe_factor(scene_, of.surface, of.lobe, transmitted, event, spectrum(kFactor), spectrum(kWork));
}

void PolarizedPathLight::add_unpolarized(const float* factor, const float* light, float weight) {
  spectra::add_scaled_product(out_.rows[0], factor, light, weight, n_);
}

namespace {

const PathRecord::Events* events_of(const PathRecord& record, std::uint32_t mixed) {
  if (mixed == PathVertex::kNone) return nullptr;
  const std::uint32_t events = record.mixed[mixed].events;
  return events == PathVertex::kNone ? nullptr : &record.events[events];
}

}  // namespace

void PolarizedPathLight::add_sun(const PathRecord& record, const PathVertex& vertex,
                                 const Directions& directions) {
  const float* sun = scene_.sun_irradiance(vertex.height_m, spectrum(kSun));
  Beam light;
  light.rows.row[0] = const_cast<float*>(sun);
  if (vertex.sun_passes != PathVertex::kNone) {
    light = source_;
    light.polarized = false;
    std::copy_n(sun, n_, light.rows[0]);
    way_.come_through(record, vertex.sun_passes, light);
  }
  const PathRecord::Events* events = events_of(record, vertex.mixed);
  if (directions.polarizing != nullptr && events != nullptr) {
    add_scattered(record.mixed[vertex.mixed], events->sun, light, vertex.sun_weight);
    return;
  }
  add_unpolarized(factor(record, vertex.mixed, vertex.sun_factor, vertex.sun_transmitted,
                         events == nullptr ? nullptr : &events->sun),
                  light.rows[0], vertex.sun_weight);
}

void PolarizedPathLight::add_sought(const PathRecord& record, const PathVertex& vertex,
                                    const Directions& directions) {
  source_.polarized = false;
  Beam light = source_;
  if (vertex.sought_mixed != PathVertex::kNone) {
    if (!emit(record.mixed[vertex.sought_mixed], light)) return;
  } else {
    if (vertex.sought_emission == nullptr) return;
    light.rows.row[0] = const_cast<float*>(vertex.sought_emission);
  }
  if (vertex.sought_passes != PathVertex::kNone) {
    if (light.rows[0] == vertex.sought_emission) {
      light.rows = source_.rows;
      std::copy_n(vertex.sought_emission, n_, light.rows[0]);
    }
    way_.come_through(record, vertex.sought_passes, light);
  }
  const PathRecord::Events* events = events_of(record, vertex.mixed);
  if (directions.polarizing != nullptr && events != nullptr) {
    add_scattered(record.mixed[vertex.mixed], events->sought, light, vertex.sought_weight);
    return;
  }
  add_unpolarized(factor(record, vertex.mixed, vertex.sought_factor, vertex.sought_transmitted,
                         events == nullptr ? nullptr : &events->sought),
                  light.rows[0], vertex.sought_weight);
}

void PolarizedPathLight::add_mirrored(const PathRecord& record, const PathVertex& vertex,
                                      const Directions& directions) {
  for (std::uint32_t k = vertex.mirrored; k != PathVertex::kNone; k = record.mirrored[k].next) {
    const PathRecord::Mirrored& way = record.mirrored[k];
    Beam& light = source_;
    light.polarized = false;
    if (!way.emitted) {
      std::copy_n(scene_.sun_irradiance(way.height_m, spectrum(kSun)), n_, light.rows[0]);
    } else if (way.emission_mixed != PathVertex::kNone) {
      if (!emit(record.mixed[way.emission_mixed], light)) continue;
    } else {
      if (way.emission == nullptr) continue;
      std::copy_n(way.emission, n_, light.rows[0]);
    }
    way_.come_by(record, way, light);
    const LobeEvent* event =
        way.surface.event == PathVertex::kNone ? nullptr : &record.way_events[way.surface.event];
    if (directions.polarizing != nullptr && event != nullptr) {
      add_scattered(record.mixed[way.surface.mixed], *event, light, way.weight);
      continue;
    }
    add_unpolarized(factor(record, way.surface.mixed, way.surface.spectrum, way.transmitted, event),
                    light.rows[0], way.weight);
  }
}

void PolarizedPathLight::add_continuation(const PathRecord& record, const PathVertex& vertex,
                                          const Directions& directions) {
  const PathRecord::Events* events = events_of(record, vertex.mixed);
  const LobeEvent* event = events == nullptr ? nullptr : &events->continuation;
  if (directions.polarizing != nullptr && event != nullptr) {
    Beam light = arriving_;
    // Under a shading normal light may have come mirrored by the surface itself.
    if (light.polarized && math::dot(event->event.incoming, directions.incoming) < 1.0 - 1e-9)
      light.frame = reflect(light.frame, -event->event.incoming, light.rows, n_);
    add_scattered(record.mixed[vertex.mixed], *event, light, vertex.continuation_weight);
    return;
  }
  const float* values =
      factor(record, vertex.mixed, vertex.continuation_factor, vertex.continuation_transmitted, event);
  if (directions.polarizing == nullptr || !arriving_.polarized) {
    add_unpolarized(values, arriving_.rows[0], vertex.continuation_weight);
    return;
  }
  // A mirror: its matrix over its factor is the same in all wavelengths.
  const materials::BsdfEvent delta{
      directions.outgoing,
      directions.incoming,
      math::as_normal(directions.normal),
      {},
      vertex.continuation_transmitted ? materials::Side::transmitted : materials::Side::reflected};
  const materials::MuellerRows matrix{spectrum(kMueller), n_, true};
  directions.polarizing->evaluate_mueller(delta, {}, n_, matrix);
  for (std::size_t c = 0; c < 4; ++c) spectra::scale(arriving_.rows[c], values, n_);
  add_times(matrix, arriving_, delta, vertex.continuation_weight);
}

void PolarizedPathLight::add_scattered(const PathRecord::Mixed& mixed, const LobeEvent& event,
                                       const Beam& light, float weight) {
  const materials::MuellerRows matrix{spectrum(kMueller), n_, light.polarized};
  if (event.weight > 0.0f) {
    lobe_mueller(scene_, mixed.surface, mixed.lobe, event.event, matrix, spectrum(kMuellerWork));
    add_times(matrix, light, event.event, weight * event.weight);
  }
  if (event.image_weight > 0.0f) {
    materials::BsdfEvent other = event.event;
    other.incoming = event.image;
    Beam mirrored = light;
    if (light.polarized) mirrored.frame = reflect(light.frame, -event.image, light.rows, n_);
    lobe_mueller(scene_, mixed.surface, mixed.lobe, other, matrix, spectrum(kMuellerWork));
    add_times(matrix, mirrored, other, weight * event.image_weight);
  }
}

void PolarizedPathLight::add_times(const materials::MuellerRows& matrix, const Beam& light,
                                   const materials::BsdfEvent& event, float weight) {
  polarize(out_);
  StokesRows from = light.rows;
  if (light.polarized) {
    const FrameTurn turn(light.frame, radiometry::surface_frame(-event.incoming, event.normal.as_vector()));
    const float* __restrict before_q = light.rows[1];
    const float* __restrict before_u = light.rows[2];
    from.row[1] = spectrum(kTurned);
    from.row[2] = spectrum(kTurned + 1);
    float* __restrict q = from.row[1], * __restrict u = from.row[2];
    for (std::size_t i = 0; i < n_; ++i) {
      q[i] = turn.cosine * before_q[i] + turn.sine * before_u[i];
      u[i] = turn.cosine * before_u[i] - turn.sine * before_q[i];
    }
  }
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < matrix.columns(); ++c)
      spectra::add_scaled_product(out_.rows[r], matrix.at(r, c), from[c], weight, n_);
}

}  // namespace ifov::transport
