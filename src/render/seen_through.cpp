#include "render/seen_through.h"

#include "geometry/world.h"
#include "materials/bsdf/node_bsdf.h"
#include "sampling/hash.h"
#include "scene/scene.h"
#include "transport/delta_events.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Surfaces that are looked through, one behind another.
constexpr int kMostPassed = 8;
/// Of light: less shows nothing.
constexpr double kFaint = 1e-3;

}  // namespace

SeenThrough::SeenThrough(const transport::SpectralScene& scene)
    : scene_(scene), any_(scene.materials().any_pane() || scene.materials().any_medium()) {}

bool SeenThrough::turn(math::Ray& ray, const geometry::SurfacePoint& hit, bool only_straight) const {
  const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
  materials::BsdfEvent view = transport::delta_view(-ray.direction, hit, surface);
  view.side = materials::Side::transmitted;
  for (const scene::Constituent& part : surface) {
    const materials::NodeBsdf* model = scene_.materials().directional(part.material);
    const materials::Bsdf& bsdf = *scene_.scene().materials[part.material].bsdf;
    if (model == nullptr || bsdf.passage() == materials::Passage::none || !bsdf.is_delta()) continue;
    if (only_straight && bsdf.passage() != materials::Passage::straight) continue;
    if (!(part.weight * model->highest_share(view, view.side) > kFaint)) continue;
    const materials::BsdfSample sample = bsdf.sample(view, 0.5, 0.5);
    if (!(sample.weight > 0.0)) continue;
    ray = ray.onward(transport::beyond_surface(hit), sample.incoming);
    return true;
  }
  return false;
}

void SeenThrough::follow(std::span<math::Ray> rays, std::span<geometry::SurfacePoint> hits,
                         std::span<std::uint64_t> states, sampling::RayCounts& counts) {
  going_.clear();
  for (std::uint32_t k = 0; k < rays.size(); ++k) {
    states[k] = 0;
    if (hits[k].hit()) going_.push_back(k);
  }
  for (int passed = 0; passed < kMostPassed && !going_.empty(); ++passed) {
    next_.clear();
    rays_.clear();
    for (const std::uint32_t k : going_) {
      math::Ray onward = rays[k];
      if (!turn(onward, hits[k], false)) continue;
      next_.push_back(k);
      rays_.push_back(onward);
    }
    hits_.resize(rays_.size());
    if (!rays_.empty()) scene_.scene().world->intersect(rays_, hits_);
    counts.primary += rays_.size();
    going_.clear();
    for (std::size_t j = 0; j < next_.size(); ++j) {
      const std::uint32_t k = next_[j];
      rays[k] = rays_[j];
      hits[k] = hits_[j];
      std::uint64_t met = 1;
      if (hits[k].hit()) {
        const std::uint32_t material = scene_.scene().resolve(hits[k]).constituents[0].material;
        met = sampling::hash(hits[k].instance, hits[k].patch, material, hits[k].front ? 3u : 2u);
        going_.push_back(k);
      }
      states[k] = sampling::hash(states[k], met) | 1;
    }
  }
}

std::uint64_t SeenThrough::passed(math::Ray ray, sampling::RayCounts& counts) {
  if (!scene_.materials().any_pane()) return 0;
  std::uint64_t state = 0;
  for (int passed = 0; passed <= kMostPassed; ++passed) {
    geometry::SurfacePoint hit;
    scene_.scene().world->intersect({&ray, 1}, {&hit, 1});
    ++counts.shadow;
    if (!hit.hit()) return state;
    if (!turn(ray, hit, true)) return 0;
    state = sampling::hash(state, scene_.scene().resolve(hit).constituents[0].material) | 1;
  }
  return 0;
}

}  // namespace ifov::render
