#include "transport/view_atmosphere.h"

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
void dim(float* __restrict light, const ViewTable::Weights& at, std::size_t n) {
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

}  // namespace

void add_adjacent_ground(const SpectralScene& scene, const PathRecord::Path& path,
                         const ViewTable::Weights* at, float* __restrict light) {
  const AdjacentGround* adjacent = scene.adjacent_ground();
  if (adjacent == nullptr) return;
  const std::size_t n = scene.stride();
  const AdjacentGround::Corners corners = adjacent->at(path.seen_x_m, path.seen_y_m);
  if (at == nullptr) {
    spectra::add_product_of_scaled(light, scene.view_diffuse(), corners.radiance.data(),
                                   corners.weight.data(), n);
    return;
  }
  const std::array<const float*, 5> d = scene.view_table()->diffuse(*at);
  const float *w = at->weight.data(), *v = corners.weight.data();
  const auto* r = corners.radiance.data();
  for (std::size_t i = 0; i < n; ++i)
    light[i] += (d[0][i] * w[0] + d[1][i] * w[1] + d[2][i] * w[2] + d[3][i] * w[3] + d[4][i] * w[4]) *
                (r[0][i] * v[0] + r[1][i] * v[1] + r[2][i] * v[2] + r[3][i] * v[3]);
}

void ViewAtmosphere::apply(const PathRecord::Path& path, float* first, float* second) const {
  const std::size_t n = scene_.stride();
  if (const ViewTable* table = scene_.view_table()) {
    if (!path.met && path.towards_sensor.z <= 0.0) return;  // the sky itself
    const ViewTable::Weights at = table->at(path.towards_sensor, path.seen_height_m, path.sensor_height_m);
    see_through(first, at, n);
    add_adjacent_ground(scene_, path, &at, first);
    if (second != nullptr) dim(second, at, n);
  } else if (scene_.has_view_path()) {
    apply(path, first);
    if (second != nullptr) spectra::scale(second, scene_.view_transmittance(), n);
  }
}

void ViewAtmosphere::apply(const PathRecord::Path& path, float* radiance) const {
  const std::size_t n = scene_.stride();
  if (const ViewTable* table = scene_.view_table()) {
    if (!path.met && path.towards_sensor.z <= 0.0) return;  // the sky itself
    const ViewTable::Weights at = table->at(path.towards_sensor, path.seen_height_m, path.sensor_height_m);
    see_through(radiance, at, n);
    add_adjacent_ground(scene_, path, &at, radiance);
  } else if (scene_.has_view_path()) {
    spectra::scale(radiance, scene_.view_transmittance(), n);
    spectra::add_scaled(radiance, scene_.view_radiance(), 1.0f, n);
    add_adjacent_ground(scene_, path, nullptr, radiance);
  }
}

}  // namespace ifov::transport
