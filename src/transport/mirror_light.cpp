#include "transport/mirror_light.h"

#include <algorithm>
#include <cmath>

#include "sampling/hash.h"
#include "transport/delta_events.h"
#include "transport/mirrors/sun_disc.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

namespace {

/// Of the Sun's irradiance: less is no light.
constexpr double kLeast = 1.0 / 64.0;

}  // namespace

std::unique_ptr<MirrorLight> MirrorLight::find(const SpectralScene& scene, const SunImages& images,
                                               int reflections) {
  const SunMirrors* mirrors = scene.sun_mirrors();
  if (mirrors == nullptr || reflections <= 0) return nullptr;
  if (images.images().empty() && mirrors->rounds().all().empty()) return nullptr;
  return std::unique_ptr<MirrorLight>(new MirrorLight(scene, images));
}

MirrorLight::MirrorLight(const SpectralScene& scene, const SunImages& images)
    : scene_(scene),
      mirrors_(*scene.sun_mirrors()),
      images_(images),
      tracer_(scene.scene(), mirrors_, images_, scene.materials().any_pane()) {
  for (const SunImages::Image& image : images_.images()) {
    if (disc_points_.size() == kMostImages) break;
    disc_points_.push_back(fixed_disc_points(image.direction, scene.scene().sun->half_angle_rad));
  }
}

void MirrorLight::ask(std::uint32_t owner, const math::Ray& seen, const geometry::SurfacePoint& hit,
                      math::Vec3 outward) {
  const std::size_t before = ways_.size();
  const auto send = [&](Way way, math::Vec3 direction) {
    way.asked = static_cast<std::uint32_t>(asked_.size());
    way.ray = seen.onward(hit.position_m + hit.offset_m * outward, direction);
    ways_.push_back(way);
  };
  const double slope = std::tan(scene_.scene().sun->half_angle_rad);
  for (std::uint32_t k = 0; k < disc_points_.size(); ++k) {
    const SunImages::Image& image = images_.images()[k];
    if (!may_meet(image.bounds, hit.position_m, image.direction, slope)) continue;
    for (std::uint32_t p = 0; p < disc_points_[k].size(); ++p) {
      if (!(math::dot(disc_points_[k][p], outward) > 0.0)) continue;
      Way way;
      way.image = k;
      send(way, disc_points_[k][p]);
    }
  }
  const math::Vec3 towards_sun = scene_.scene().sun->direction;
  for (const RoundMirror& round : mirrors_.rounds().all()) {
    const auto image = round.image(hit.position_m, towards_sun);
    if (!image) continue;
    Way way;
    way.light = math::dot(image->direction, outward) / image->spread();
    if (!(way.light > kLeast)) continue;
    way.object = round.object();
    way.at = image->at;
    way.towards_sun = towards_sun;
    send(way, image->direction);
  }
  if (ways_.size() > before) asked_.push_back({owner, 0.0, {}});
}

void MirrorLight::trace(sampling::RayCounts& counts) {
  tracer_.trace(
      ways_, counts,
      [&](Way& way, const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface) {
        double share = 0.0;
        if (scene_.materials().any_pane() || scene_.materials().any_medium())
          share = highest_of_deltas(scene_, surface, delta_view(way.ray.direction, hit, surface),
                                    SurfaceLobe::Deltas::mirrors);
        else
          for (const scene::Constituent& part : surface)
            if (is_mirror(scene_.scene(), part)) share += part.weight * scene_.brightest(part.material);
        way.light *= share;
      },
      [&](const Way& way) {
        Asked& point = asked_[way.asked];
        if (way.image == MirrorPath::kRound)
          point.round_light += way.light;
        else if (point.seen[way.image] < 255)
          ++point.seen[way.image];
      },
      [&](const Way& way, const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface,
          bool through) {
        return through && !passes_straight(scene_, surface)
                   ? 0.0
                   : highest_of_deltas(scene_, surface, delta_view(-way.ray.direction, hit, surface),
                                       through ? SurfaceLobe::Deltas::panes : SurfaceLobe::Deltas::mirrors);
      },
      [&](const Way&, const geometry::SurfacePoint&, const scene::ResolvedSurface&) {});
}

MirrorLight::State MirrorLight::state_of(const Asked& point) const {
  State state;
  std::uint64_t images = 0;
  for (std::size_t k = 0; k < disc_points_.size(); ++k) {
    if (point.seen[k] == 0) continue;
    const bool whole = point.seen[k] % disc_points_[k].size() == 0;
    images += sampling::hash(k, whole);
    state.uneven = state.uneven || !whole;
  }
  const int step = point.round_light > kLeast ? 1 + std::ilogb(point.round_light / kLeast) : 0;
  state.uneven = state.uneven || step != 0;
  if (step != 0 || images != 0) state.bits = sampling::hash(images, static_cast<std::uint64_t>(step)) | 1;
  return state;
}

}  // namespace ifov::transport
