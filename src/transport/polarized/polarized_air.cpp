#include "transport/polarized/polarized_air.h"

#include "radiometry/polarization_frame.h"
#include "transport/sky/adjacent_ground.h"
#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"
#include "transport/view_table.h"

namespace ifov::transport {

bool PolarizedAir::is_sky(const PathRecord::Path& path) const {
  return scene_.view_table() != nullptr && !path.met && path.towards_sensor.z <= 0.0;
}

void PolarizedAir::see_through(const PathRecord::Path& path, const StokesRows& light) const {
  if (!scene_.has_view_path() || is_sky(path)) return;
  const std::size_t n = scene_.stride();
  const ViewTable* table = scene_.view_table();
  if (table == nullptr) {
    for (float* row : light.row) spectra::scale(row, scene_.view_transmittance(), n);
    return;
  }
  const ViewTable::Weights at = table->at(path.towards_sensor, path.seen_height_m, path.sensor_height_m);
  for (std::size_t i = 0; i < n; ++i) {
    float transmittance = 0.0f;
    for (std::size_t k = 0; k < at.count; ++k) transmittance += at.weight[k] * at.transmittance[k][i];
    for (float* row : light.row) row[i] *= transmittance;
  }
}

void PolarizedAir::add_path(const PathRecord::Path& path, const radiometry::PolarizationFrame& frame,
                            const StokesRows& light) const {
  if (!scene_.has_view_path() || is_sky(path)) return;
  const std::size_t n = scene_.stride();
  const ViewTable *table = scene_.view_table(), *polarized = scene_.polarized_path();
  ViewTable::Weights at;
  if (table != nullptr || polarized != nullptr)
    at = (table != nullptr ? table : polarized)
             ->at(path.towards_sensor, path.seen_height_m, path.sensor_height_m);
  if (table == nullptr)
    spectra::add_scaled(light[0], scene_.view_radiance(), 1.0f, n);
  else
    for (std::size_t k = 0; k < at.count; ++k) spectra::add_scaled(light[0], at.radiance[k], at.weight[k], n);
  if (const AdjacentGround* adjacent = scene_.adjacent_ground()) {
    if (table == nullptr)
      adjacent->add(path.seen_x_m, path.seen_y_m, scene_.view_diffuse(), light[0]);
    else
      adjacent->add(path.seen_x_m, path.seen_y_m, table->diffuse(at), at.weight, light[0]);
  }
  if (polarized == nullptr) return;
  const ViewTable::Polarization added = polarized->polarization(at, path.towards_sensor, frame);
  for (std::size_t k = 0; k < at.count; ++k) {
    const float c = added.cosine * at.weight[k], s = added.sine * at.weight[k];
    spectra::add_scaled(light[1], added.q[k], c, n);
    spectra::add_scaled(light[1], added.u[k], s * added.side, n);
    spectra::add_scaled(light[2], added.u[k], c * added.side, n);
    spectra::add_scaled(light[2], added.q[k], -s, n);
  }
}

}  // namespace ifov::transport
