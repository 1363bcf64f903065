#include "render/mirrors/mirrored_spectra.h"

#include <algorithm>
#include <optional>

#include "materials/bsdf/node_bsdf.h"
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
      share_(scene.node_count()),
      channels_(std::max(scene.nodes().channel_count(), scene.stride())) {}

std::span<const float> MirroredSpectra::channels(const scene::ResolvedSurface& surface, double height_m,
                                                 const math::Ray& seen, const float* light) {
  std::fill(share_.begin(), share_.end(), 0.0);
  materials::BsdfEvent view;
  view.outgoing = -seen.direction;
  view.normal = surface.shading_normal;
  if (view.outgoing_cosine() < 0.0) view.normal = -view.normal;
  for (const scene::Constituent& part : surface)
    if (transport::is_mirror(scene_.scene(), part)) {
      const float* reflectance = scene_.materials().reflectance(part.material);
      if (const materials::NodeBsdf* model = scene_.materials().directional(part.material)) {
        model->evaluate(view, by_angle_.row(0));
        reflectance = by_angle_.row(0);
      }
      for (std::size_t n = 0; n < share_.size(); ++n) share_[n] += part.weight * reflectance[n];
    }
  const transport::ViewTable* table = scene_.view_table();
  std::optional<transport::ViewTable::Weights> weights;
  if (table != nullptr) weights = table->at(-seen.direction, height_m, seen.origin_m.z);
  float* reflected = work_.row(0);
  for (std::size_t n = 0; n < share_.size(); ++n) {
    double transmittance = scene_.has_view_path() ? scene_.view_transmittance()[n] : 1.0;
    if (weights) {
      transmittance = 0.0;
      for (std::size_t k = 0; k < weights->count; ++k)
        transmittance += weights->weight[k] * weights->transmittance[k][n];
    }
    reflected[n] = static_cast<float>(share_[n] * light[n] * transmittance);
  }
  scene_.nodes().to_channels(reflected, channels_.data());
  return {channels_.data(), scene_.nodes().channel_count()};
}

}  // namespace ifov::render
