#include "render/mirrors/mirrored_spectra.h"

#include <algorithm>
#include <optional>

#include "materials/bsdf/node_bsdf.h"
#include "radiometry/polarization_frame.h"
#include "scene/scene.h"
#include "transport/mirrors/mirror_paths.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/spectral_scene.h"
#include "transport/view_table.h"

namespace ifov::render {

MirroredSpectra::MirroredSpectra(const transport::SpectralScene& scene)
    : scene_(scene),
      work_(1, scene.node_count()),
      by_angle_(1, scene.node_count()),
      stokes_(4, scene.node_count()),
      matrix_(4, scene.node_count()),
      share_(scene.node_count()),
      transmittance_(scene.node_count()),
      channels_(std::max(scene.nodes().channel_count(), scene.stride())) {}

namespace {

materials::BsdfEvent mirror_view(const scene::ResolvedSurface& surface, const math::Ray& seen) {
  materials::BsdfEvent view;
  view.outgoing = -seen.direction;
  view.normal = surface.shading_normal;
  if (view.outgoing_cosine() < 0.0) view.normal = -view.normal;
  return view;
}

}  // namespace

void MirroredSpectra::find_transmittance(double height_m, const math::Ray& seen) {
  const transport::ViewTable* table = scene_.view_table();
  std::optional<transport::ViewTable::Weights> weights;
  if (table != nullptr) weights = table->at(-seen.direction, height_m, seen.origin_m.z);
  for (std::size_t n = 0; n < transmittance_.size(); ++n) {
    transmittance_[n] = scene_.has_view_path() ? scene_.view_transmittance()[n] : 1.0;
    if (!weights) continue;
    transmittance_[n] = 0.0;
    for (std::size_t k = 0; k < weights->count; ++k)
      transmittance_[n] += weights->weight[k] * weights->transmittance[k][n];
  }
}

std::span<const float> MirroredSpectra::channels(const scene::ResolvedSurface& surface, double height_m,
                                                 const math::Ray& seen, const float* light) {
  std::fill(share_.begin(), share_.end(), 0.0);
  const materials::BsdfEvent view = mirror_view(surface, seen);
  for (const scene::Constituent& part : surface)
    if (transport::is_mirror(scene_.scene(), part)) {
      const float* reflectance = scene_.materials().reflectance(part.material);
      if (const materials::NodeBsdf* model = scene_.materials().directional(part.material)) {
        model->evaluate(view, by_angle_.row(0));
        reflectance = by_angle_.row(0);
      }
      for (std::size_t n = 0; n < share_.size(); ++n) share_[n] += part.weight * reflectance[n];
    }
  find_transmittance(height_m, seen);
  float* reflected = work_.row(0);
  for (std::size_t n = 0; n < share_.size(); ++n)
    reflected[n] = static_cast<float>(share_[n] * light[n] * transmittance_[n]);
  scene_.nodes().to_channels(reflected, channels_.data());
  return {channels_.data(), scene_.nodes().channel_count()};
}

transport::StokesRows MirroredSpectra::polarized(const scene::ResolvedSurface& surface, double height_m,
                                                 const math::Ray& seen, const float* light,
                                                 const radiometry::PolarizationFrame& frame) {
  const std::size_t n = scene_.stride();
  materials::BsdfEvent view = mirror_view(surface, seen);
  const math::Vec3 normal = view.normal.as_vector();
  view.incoming = math::normalized(2.0 * math::dot(normal, view.outgoing) * normal - view.outgoing);
  const transport::StokesRows rows{{stokes_.row(0), stokes_.row(1), stokes_.row(2), stokes_.row(3)}};
  for (float* row : rows.row) std::fill_n(row, n, 0.0f);
  for (const scene::Constituent& part : surface) {
    if (!transport::is_mirror(scene_.scene(), part)) continue;
    const auto weight = static_cast<float>(part.weight);
    const materials::NodeBsdf* model = scene_.materials().directional(part.material);
    if (model == nullptr) {  // a plane mirror leaves it unpolarized
      const float* reflectance = scene_.materials().reflectance(part.material);
      for (std::size_t k = 0; k < n; ++k) rows[0][k] += weight * reflectance[k];
      continue;
    }
    model->evaluate_mueller(view, {matrix_.row(0), n, false});
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t k = 0; k < n; ++k) rows[r][k] += weight * matrix_.row(r)[k];
  }
  find_transmittance(height_m, seen);
  for (float* row : rows.row)
    for (std::size_t k = 0; k < transmittance_.size(); ++k)
      row[k] *= light[k] * static_cast<float>(transmittance_[k]);
  transport::FrameTurn(radiometry::surface_frame(view.outgoing, normal), frame).apply(rows, n);
  return rows;
}

}  // namespace ifov::render
