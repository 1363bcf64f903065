#include "render/scene_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "render/moving/moving_cover.h"
#include "render/polarized/scene_light.h"
#include "sensor/camera.h"
#include "transport/mirror_light.h"
#include "transport/mirrors/sun_disc.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

SceneField::SceneField(const transport::SpectralScene& scene, const sensor::Camera& camera,
                       transport::TransportOptions transport, LabelDetail detail, const LightTold& told)
    : scene_(scene),
      camera_(camera),
      detail_(detail),
      tracer_(std::make_unique<transport::PathTracer>(scene, transport)),
      light_(std::make_unique<SceneLight>(scene, camera, told)),
      truth_(scene::truth_materials(scene.scene())),
      blends_(scene.scene(), truth_, static_cast<int>(light_->columns().count()),
              MovingCover::find(scene.scene(), camera) != nullptr),
      unseen_(scene, blends_.first_column() + blends_.count()),
      through_(scene),
      moving_(MovingCover::find(scene.scene(), camera)),
      mirror_light_(
          detail == LabelDetail::sun_state
              ? transport::MirrorLight::find(scene, tracer_->sun_images(), transport.mirror_reflections)
              : nullptr) {
  if (scene.scene().sun)
    disc_points_ =
        transport::fixed_disc_points(scene.scene().sun->direction, scene.scene().sun->half_angle_rad);
  const std::vector<materials::Material>& materials = scene.scene().materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    sunlight_.push_back({scene.brightest(m) > 0.0 && !materials[m].bsdf->is_delta(),
                         scene.materials().maximum_transmittance(m) > 0.0f});
}

SceneField::~SceneField() = default;

int SceneField::leader(int column) const { return light_->columns().leader(column); }

int SceneField::channel_of(int column) const {
  return column < blends_.first_column() ? light_->columns().channel_of(column) : -1;
}

void SceneField::settle(sampling::TileResult& tile) const { light_->columns().settle(tile); }

void SceneField::labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) {
  rays_.resize(points.size());
  hits_.resize(points.size());
  camera_.rays(points, rays_);
  scene_.scene().world->intersect(rays_, hits_);
  counts_.primary += points.size();
  find_covered(points);
  label_hits(points, hits_, detail_, labels, {});
}

void SceneField::find_covered(std::span<const sampling::FocalPoint> points) {
  if (moving_ == nullptr) return;
  covered_.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    covered_[k] = moving_->covers(points[k], rays_[k], hits_[k]);
}

std::uint32_t SceneField::object_of(sampling::Label label) const {
  const bool sky = SurfaceLabel::material_of(label) == SurfaceLabel::kSky;
  return sky || scene_.scene().world->object_count() > SurfaceLabel::kMaximumInstances
             ? kNoObject
             : SurfaceLabel::instance_of(label);
}

std::uint32_t SceneField::material_of(sampling::Label label) const {
  const std::uint32_t material = SurfaceLabel::material_of(label);
  if (material == SurfaceLabel::kBlend) return BlendColumns::kNoMaterial;
  return material == SurfaceLabel::kSky ? truth_.of_material[scene_.scene().surroundings.material] : material;
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

void SceneField::values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
                        std::span<float> values) {
  this->values(requests, labels, values, detail_, {});
}

void SceneField::values_expecting(std::span<const sampling::PathRequest> requests,
                                  std::span<const sampling::Label> expected,
                                  std::span<sampling::Label> labels, std::span<float> values) {
  this->values(requests, labels, values, detail_, expected);
}

void SceneField::values_and_materials(std::span<const sampling::PathRequest> requests,
                                      std::span<sampling::Label> labels, std::span<float> values) {
  this->values(requests, labels, values, LabelDetail::material, {});
}

void SceneField::values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
                        std::span<float> values, LabelDetail detail,
                        std::span<const sampling::Label> expected) {
  if (moving_ != nullptr) return moving_values(requests, labels, values, detail);
  if (shared_ != nullptr) return shared_->values(*this, requests, labels, values);
  const std::size_t row_length = static_cast<std::size_t>(stride());
  for (std::size_t first = 0; first < requests.size(); first += kMostTraced) {
    const std::size_t count = std::min(kMostTraced, requests.size() - first);
    const transport::PathRecord& paths = trace_paths(requests.subspan(first, count));
    for (std::size_t k = 0; k < count; ++k) write(*this, paths, k, values.data() + (first + k) * row_length);
    label_hits(points_, hits_, detail, labels.subspan(first, count),
               expected.empty() ? Expected{} : Expected{expected.subspan(first, count), &paths});
  }
}

void SceneField::moving_values(std::span<const sampling::PathRequest> requests,
                               std::span<sampling::Label> labels, std::span<float> values,
                               LabelDetail detail) {
  constexpr std::size_t kTogether = kMostTraced / 2;
  const std::size_t row_length = static_cast<std::size_t>(stride());
  std::vector<sampling::PathRequest> asked;
  std::vector<float> shares(kTogether), row(row_length);
  std::vector<sampling::Label> met;
  for (std::size_t first = 0; first < requests.size(); first += kTogether) {
    const std::span<const sampling::PathRequest> group =
        requests.subspan(first, std::min(kTogether, requests.size() - first));
    points_.resize(group.size()), rays_.resize(group.size()), hits_.resize(group.size());
    for (std::size_t k = 0; k < group.size(); ++k) points_[k] = group[k].point;
    camera_.rays(points_, rays_);
    moving_->meet_still(rays_, hits_);
    counts_.primary += group.size();
    asked.clear();
    for (std::size_t k = 0; k < group.size(); ++k) {
      const MovingCover::Times times = moving_->times(group[k], rays_[k], hits_[k]);
      shares[k] = static_cast<float>(times.share);
      for (const bool meeting : {true, false}) {
        if (shares[k] == (meeting ? 0.0f : 1.0f)) continue;
        asked.push_back(group[k]);
        asked.back().point.time_s += meeting ? times.met_s : times.else_s;
      }
    }
    const transport::PathRecord& paths = trace_paths(asked);
    for (std::size_t k = 0, j = 0; k < group.size(); ++k) {
      float* const value = values.data() + (first + k) * row_length;
      write(*this, paths, j++, value);
      if (shares[k] == 0.0f || shares[k] == 1.0f) continue;
      write(*this, paths, j++, row.data());
      for (std::size_t c = 0; c < row_length; ++c)
        value[c] = shares[k] * value[c] + (1.0f - shares[k]) * row[c];
    }
    met.resize(asked.size());
    label_hits(points_, hits_, detail, met, {});
    for (std::size_t k = 0, j = 0; k < group.size(); ++k) {
      labels[first + k] = met[j];
      j += shares[k] == 0.0f || shares[k] == 1.0f ? 1 : 2;
    }
  }
}

const transport::PathRecord& SceneField::trace_paths(std::span<const sampling::PathRequest> requests) {
  const std::size_t count = requests.size();
  points_.resize(count);
  keys_.resize(count);
  rays_.resize(count);
  hits_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    points_[k] = requests[k].point;
    keys_[k] = {requests[k].sequence, requests[k].index};
  }
  camera_.rays(points_, rays_);
  const transport::PathRecord& paths = tracer_->trace(rays_, keys_, hits_, counts_);
  find_covered(points_);
  return paths;
}

const transport::PathRecord& SceneField::trace(std::span<const sampling::PathRequest> requests,
                                               std::span<sampling::Label> labels) {
  const transport::PathRecord& paths = trace_paths(requests);
  label_hits(points_, hits_, detail_, labels, {});
  return paths;
}

void SceneField::write(const SceneField& by, const transport::PathRecord& paths, std::size_t k, float* row) {
  light_->write(paths, k, by.points_[k], by.rays_[k], row);
  if (by.moving_ != nullptr && by.covered_[k] != 0)
    blends_.write_shares(by.hits_[k], row, true);
  else if (blends_.count() > 0)
    blends_.write_shares(by.hits_[k], row);
  unseen_.write(paths.paths[k], row);
}

bool SceneField::is_expected(const SurfaceLabel& label, const Expected& expected, std::size_t k) {
  using SunSeen = transport::PathRecord::Path::SunSeen;
  if (expected.paths == nullptr) return false;
  const sampling::Label wanted = expected.labels[k];
  SurfaceLabel as_wanted = label;
  as_wanted.sun = SurfaceLabel::sun_of(wanted);
  if (as_wanted.pack() != wanted) return false;
  const SunSeen seen = expected.paths->paths[k].first_sun;
  return (as_wanted.sun == SunState::lit && seen == SunSeen::seen) ||
         (as_wanted.sun == SunState::shaded && seen == SunSeen::hidden);
}

void SceneField::label_hits(std::span<const sampling::FocalPoint> points,
                            std::span<const geometry::SurfacePoint> hits, LabelDetail detail,
                            std::span<sampling::Label> labels, const Expected& expected) {
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
      // No material of its own, and uneven as penumbras are.
      labels[k] =
          SurfaceLabel{SurfaceLabel::kMoving, 0, SurfaceLabel::kBlend, true, SunState::penumbra}.pack();
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
          if (label.sun == SunState::lit && (!through_.any() || passed_[k] == 0) &&
              is_expected(label, expected, k)) {
            label.sun = SurfaceLabel::sun_of(expected.labels[k]);
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
  if (mirror_light_ != nullptr)
    mirror_light_->answer(counts_, [&](std::uint32_t k, std::uint64_t state, bool uneven) {
      labels[k] = SurfaceLabel::with_mirrored(labels[k], state, uneven);
    });
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
