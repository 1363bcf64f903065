#include <algorithm>

#include "geometry/world.h"
#include "render/field/scene_field.h"
#include "render/moving/moving_cover.h"
#include "sensor/camera.h"
#include "transport/mirror_light.h"
#include "transport/path_record.h"
#include "transport/spectral_scene.h"

// What points show: surfaces, and how the Sun is seen from them.

namespace ifov::render {

namespace {

/// Whether a label without the Sun's state is the one that is expected, and the Sun seen or hidden as that says.
bool is_expected(SurfaceLabel label, sampling::Label expected, transport::PathRecord::Path::SunSeen seen) {
  using SunSeen = transport::PathRecord::Path::SunSeen;
  label.sun = SurfaceLabel::sun_of(expected);
  if (label.pack() != expected) return false;
  return (label.sun == SunState::lit && seen == SunSeen::seen) ||
         (label.sun == SunState::shaded && seen == SunSeen::hidden);
}

}  // namespace

void SceneField::labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) {
  if (flown_ != nullptr) return flown_labels(points, detail_, labels);
  meet(points);
  find_covered(points);
  label_hits(points, hits_, detail_, labels);
}

bool SceneField::may_have_corners(sampling::Label a, sampling::Label b) const {
  // Who throws a shadow is not known, nor what a mirror shows or throws, and a map's cells turn anywhere.
  const std::uint32_t object = object_of(a);
  if (SurfaceLabel::sun_of(a) != SurfaceLabel::sun_of(b) || through_.any() || mirror_light_ != nullptr ||
      camera_.bends_sharply() || (object == object_of(b) && material_of(a) != material_of(b)))
    return true;
  const geometry::World& world = *scene_.scene().world;
  const auto has_corners = [&](sampling::Label label) {
    if (SurfaceLabel::material_of(label) == SurfaceLabel::kSky) return false;
    const std::uint32_t number = object_of(label);
    return number >= world.object_count() || world.has_corners(number);
  };
  return has_corners(a) || has_corners(b);
}

bool SceneField::may_be_shaded(sampling::Label label) const {
  return SurfaceLabel::sun_of(label) != SunState::none || !scene_.scene().lamps.empty();
}

void SceneField::meet(std::span<const sampling::FocalPoint> points) {
  rays_.resize(points.size());
  hits_.resize(points.size());
  camera_.rays(points, rays_);
  scene_.scene().world->intersect(rays_, hits_);
  counts_.primary += points.size();
}

bool SceneField::shows_sunlight(const scene::ResolvedSurface& surface, bool& transmits) const {
  bool shows = false;
  for (const scene::Constituent& c : surface) {
    const Sunlight& sunlight = sunlight_[c.material];
    shows = shows || sunlight.shows;
    transmits = transmits || (sunlight.shows && sunlight.passes);
  }
  return shows;
}

void SceneField::label_hits(std::span<const sampling::FocalPoint> points,
                            std::span<const geometry::SurfacePoint> hits, LabelDetail detail,
                            std::span<sampling::Label> labels, std::span<const sampling::Label> expected,
                            const transport::PathRecord* paths) {
  const scene::Scene& scene = scene_.scene();
  sun_rays_.clear();
  owner_.clear();
  // What a ray ends at, behind all that it is seen through.
  std::span<const geometry::SurfacePoint> seen = hits;
  if (through_.any()) {
    seen_.assign(hits.begin(), hits.end());
    passed_.resize(hits.size());
    through_.follow(rays_, seen_, passed_, counts_);
    seen = seen_;
  }
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const geometry::SurfacePoint& hit = hits[k];
    if (moving_ != nullptr && covered_[k] != 0) {
      labels[k] = SurfaceLabel::moving();
      continue;
    }
    SurfaceLabel label;
    label.material = SurfaceLabel::kSky;
    if (hit.hit()) {
      const scene::ResolvedSurface surface = scene.resolve_without_temperature(hit);
      const std::uint32_t material = blends_.mixes(hit.material)
                                         ? SurfaceLabel::kBlend
                                         : truth_.of_material[surface.constituents[0].material];
      label = {hit.instance, hit.patch, material, hit.front, SunState::none};
    } else if (through_.meets_sun(rays_[k].direction)) {
      label.patch = SurfaceLabel::kSunOfSky;
    }
    const geometry::SurfacePoint& lit = seen[k];
    if (lit.hit()) {
      if (detail == LabelDetail::sun_state && !disc_points_.empty()) {
        bool transmits = false;
        if (shows_sunlight(scene.resolve_without_temperature(lit), transmits)) {
          // A leaf may be lit from behind.
          const math::Vec3 normal = lit.geometric_normal.as_vector();
          const bool behind = math::dot(scene.sun->direction, normal) < 0.0;
          const math::Vec3 outward = (transmits ? !behind : lit.front) ? normal : -normal;
          std::size_t above = 0;
          for (const math::Vec3& direction : disc_points_) above += math::dot(direction, outward) > 0.0;
          label.sun = above == 0                    ? SunState::shaded
                      : above < disc_points_.size() ? SunState::penumbra
                                                    : SunState::lit;
          if (mirror_light_ != nullptr)
            mirror_light_->ask(static_cast<std::uint32_t>(k), rays_[k], lit, (lit.front ? normal : -normal));
          // Its shadow moves along, as a penumbra without a place.
          if (moving_ != nullptr && above > 0 &&
              moving_->shades(points[k], rays_[k],
                              rays_[k].onward(lit.position_m + lit.offset_m * outward, scene.sun->direction),
                              scene.sun->half_angle_rad))
            label.sun = SunState::penumbra;
          if (label.sun == SunState::lit && (!through_.any() || passed_[k] == 0) && !expected.empty() &&
              is_expected(label, expected[k], paths->paths[k].first_sun)) {
            label.sun = SurfaceLabel::sun_of(expected[k]);
          } else if (label.sun == SunState::lit) {
            owner_.push_back(static_cast<std::uint32_t>(k));
            for (const math::Vec3& direction : disc_points_)
              sun_rays_.push_back(rays_[k].onward(lit.position_m + lit.offset_m * outward, direction));
          }
        }
      }
    }
    // What is behind panes and in mirrors is not looked for one by one.
    if (moving_ != nullptr && through_.any() && passed_[k] != 0) label.sun = SunState::penumbra;
    labels[k] = label.pack();
    if (through_.any() && passed_[k] != 0)
      labels[k] = SurfaceLabel::with_mirrored(labels[k], passed_[k] >> 20,
                                              (passed_[k] & SeenThrough::kUnevenState) != 0);
  }
  const auto mirrored = [&](std::uint32_t k, std::uint64_t state, bool uneven) {
    labels[k] = SurfaceLabel::with_mirrored(labels[k], state, uneven);
  };
  // What mirrors throw past something that moves has no rims that stay.
  if (mirror_light_ != nullptr && moving_ != nullptr)
    mirror_light_->answer_changing(mirrored);
  else if (mirror_light_ != nullptr)
    mirror_light_->answer(counts_, mirrored);
  if (sun_rays_.empty()) return;
  blocked_.resize(sun_rays_.size());
  scene.world->occluded(sun_rays_, blocked_);
  counts_.shadow += sun_rays_.size();
  const std::size_t group = disc_points_.size();
  for (std::size_t g = 0; g < owner_.size(); ++g) {
    const auto blocked = static_cast<std::size_t>(
        std::count(blocked_.begin() + static_cast<std::ptrdiff_t>(g * group),
                   blocked_.begin() + static_cast<std::ptrdiff_t>((g + 1) * group), std::uint8_t{1}));
    if (blocked == 0) continue;
    SunState state = blocked == group ? SunState::shaded : SunState::penumbra;
    if (through_.any()) {
      std::uint64_t panes = 0;
      bool alike = true;
      for (std::size_t j = g * group; j < (g + 1) * group; ++j) {
        const std::uint64_t one = blocked_[j] != 0 ? through_.passed(sun_rays_[j], counts_) : 2;
        alike = alike && (j == g * group || one == panes);
        panes = one;
      }
      state = !alike ? SunState::penumbra : panes == 0 ? SunState::shaded : SunState::lit;
      if (alike && panes != 0)
        labels[owner_[g]] = SurfaceLabel::with_mirrored(labels[owner_[g]], panes >> 20, false);
    }
    labels[owner_[g]] = (labels[owner_[g]] & ~sampling::Label{3}) | static_cast<sampling::Label>(state);
  }
}

}  // namespace ifov::render
