#include "transport/view_atmosphere.h"

#include <algorithm>

#include "transport/sky/adjacent_ground.h"
#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"
#include "transport/view_table.h"

namespace ifov::transport {

namespace {

/// Light of a surface after the air before it, from 2 to 5 rows of the table.
void see_through(float* __restrict light, const ViewTable::Weights& at, std::size_t n) {
  const auto *t = at.transmittance.data(), *l = at.radiance.data();
  const float* w = at.weight.data();
  switch (at.count) {
    case 2:
      for (std::size_t i = 0; i < n; ++i)
        light[i] = light[i] * (t[0][i] * w[0] + t[1][i] * w[1]) + (l[0][i] * w[0] + l[1][i] * w[1]);
      return;
    case 3:
      for (std::size_t i = 0; i < n; ++i)
        light[i] = light[i] * (t[0][i] * w[0] + t[1][i] * w[1] + t[2][i] * w[2]) +
                   (l[0][i] * w[0] + l[1][i] * w[1] + l[2][i] * w[2]);
      return;
    case 4:
      for (std::size_t i = 0; i < n; ++i)
        light[i] = light[i] * ((t[0][i] * w[0] + t[1][i] * w[1]) + (t[2][i] * w[2] + t[3][i] * w[3])) +
                   ((l[0][i] * w[0] + l[1][i] * w[1]) + (l[2][i] * w[2] + l[3][i] * w[3]));
      return;
    case 5:
      for (std::size_t i = 0; i < n; ++i)
        light[i] = light[i] * ((t[0][i] * w[0] + t[1][i] * w[1]) + (t[2][i] * w[2] + t[3][i] * w[3]) +
                               t[4][i] * w[4]) +
                   ((l[0][i] * w[0] + l[1][i] * w[1]) + (l[2][i] * w[2] + l[3][i] * w[3]) + l[4][i] * w[4]);
      return;
  }
}

/// The same of light that the air's own is no part of.
void dim_by(float* __restrict light, const ViewTable::Weights& at, std::size_t n) {
  const auto* t = at.transmittance.data();
  const float* w = at.weight.data();
  switch (at.count) {
    case 2:
      for (std::size_t i = 0; i < n; ++i) light[i] *= t[0][i] * w[0] + t[1][i] * w[1];
      return;
    case 3:
      for (std::size_t i = 0; i < n; ++i) light[i] *= t[0][i] * w[0] + t[1][i] * w[1] + t[2][i] * w[2];
      return;
    case 4:
      for (std::size_t i = 0; i < n; ++i)
        light[i] *= (t[0][i] * w[0] + t[1][i] * w[1]) + (t[2][i] * w[2] + t[3][i] * w[3]);
      return;
    case 5:
      for (std::size_t i = 0; i < n; ++i)
        light[i] *= (t[0][i] * w[0] + t[1][i] * w[1]) + (t[2][i] * w[2] + t[3][i] * w[3]) + t[4][i] * w[4];
      return;
  }
}

/// What the ground about the place sends into the line of sight beside that all around; `at` null: without a table.
void add_adjacent(const SpectralScene& scene, const PathRecord::Path& path, const ViewTable::Weights* at,
                  float* light) {
  const AdjacentGround* adjacent = scene.adjacent_ground();
  if (adjacent == nullptr) return;
  if (at == nullptr)
    adjacent->add(path.seen_x_m, path.seen_y_m, scene.view_diffuse(), light);
  else
    adjacent->add(path.seen_x_m, path.seen_y_m, scene.view_table()->diffuse(*at), at->weight, light);
}

}  // namespace

void ViewAtmosphere::apply(const PathRecord::Path& path, float* first, float* second) const {
  const std::size_t n = scene_.stride();
  if (const ViewTable* table = scene_.view_table()) {
    if (!path.met && path.towards_sensor.z <= 0.0) return;  // the sky itself
    const ViewTable::Weights at = table->at(path.towards_sensor, path.seen_height_m, path.sensor_height_m);
    see_through(first, at, n);
    add_adjacent(scene_, path, &at, first);
    if (second != nullptr) dim_by(second, at, n);
  } else if (scene_.has_view_path()) {
    apply(path, first);
    if (second != nullptr) spectra::scale(second, scene_.view_transmittance(), n);
  }
}

void ViewAtmosphere::transmittance(const PathRecord::Path& path, float* share) const {
  std::fill_n(share, scene_.stride(), 1.0f);
  dim(path, share);
}

void ViewAtmosphere::dim(const PathRecord::Path& path, float* radiance) const {
  const std::size_t n = scene_.stride();
  if (const ViewTable* table = scene_.view_table()) {
    if (!path.met && path.towards_sensor.z <= 0.0) return;  // the sky itself
    dim_by(radiance, table->at(path.towards_sensor, path.seen_height_m, path.sensor_height_m), n);
  } else if (scene_.has_view_path()) {
    spectra::scale(radiance, scene_.view_transmittance(), n);
  }
}

void ViewAtmosphere::apply(const PathRecord::Path& path, float* radiance) const {
  const std::size_t n = scene_.stride();
  if (const ViewTable* table = scene_.view_table()) {
    if (!path.met && path.towards_sensor.z <= 0.0) return;  // the sky itself
    const ViewTable::Weights at = table->at(path.towards_sensor, path.seen_height_m, path.sensor_height_m);
    see_through(radiance, at, n);
    add_adjacent(scene_, path, &at, radiance);
  } else if (scene_.has_view_path()) {
    spectra::scale(radiance, scene_.view_transmittance(), n);
    spectra::add_scaled(radiance, scene_.view_radiance(), 1.0f, n);
    add_adjacent(scene_, path, nullptr, radiance);
  }
}

}  // namespace ifov::transport
