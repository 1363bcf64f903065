#include "render/moving/flown_exposure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/motion/moving_world.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "sensor/flying/image_way.h"

namespace ifov::render {
namespace {

/// How far the picture may move from one instant of labels to the next: as far apart as samplers' lattices look for what is small.
constexpr double kApart_px = 0.2;
constexpr double kMostInstants = 64.0;
/// As far away as this all places of a scene and its sensor are one.
constexpr double kFarAway_m = 1e9;

/// Of labels: no band of them is narrower than what is found.
double reach_px(const FlownExposure::Dot& dot) { return std::max(dot.radius_px, 0.2); }

struct PixelBox {
  int x0 = std::numeric_limits<int>::max(), y0 = x0, x1 = std::numeric_limits<int>::min(), y1 = x1;
  PixelBox with(const PixelBox& other) const {
    return {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1), std::max(y1, other.y1)};
  }
};

/// The pixels that it may be found in.
PixelBox box_of(const FlownExposure::Dot& dot) {
  const sampling::FocalPoint next = dot.next.value_or(dot.at);
  const double reach = reach_px(dot);
  const auto low = [&](double a, double b) { return static_cast<int>(std::floor(std::min(a, b) - reach)); };
  const auto high = [&](double a, double b) { return static_cast<int>(std::floor(std::max(a, b) + reach)); };
  return {low(dot.at.x_px, next.x_px), low(dot.at.y_px, next.y_px), high(dot.at.x_px, next.x_px),
          high(dot.at.y_px, next.y_px)};
}

/// Where along its way something small is nearest to a point, if it went on for ever.
struct Passage {
  double share = 0.0, way_px = 0.0, aside_px = 0.0;
};

}  // namespace

FlownExposure::FlownExposure(const scene::Scene& scene, const sensor::Camera& camera)
    : scene_(scene), camera_(camera), exposure_s_(camera.exposure_s()), way_px_(longest_way_px()) {
  const double parts = std::clamp(std::ceil(way_px_ / kApart_px), 2.0, kMostInstants);
  apart_px_ = std::max(kApart_px, way_px_ / parts);
  for (int k = 0; k <= static_cast<int>(parts); ++k) instants_s_.push_back(exposure_s_ * (k / parts - 0.5));
}

std::unique_ptr<FlownExposure> FlownExposure::find(const scene::Scene& scene, const sensor::Camera& camera) {
  if (!camera.moves_while_exposed()) return nullptr;
  return std::unique_ptr<FlownExposure>(new FlownExposure(scene, camera));
}

double FlownExposure::longest_way_px() const {
  double longest_px = 0.0;
  for (const sampling::FocalPoint& point : sensor::grid_over(camera_, 3, 3)) {
    const math::Ray ray = camera_.ray(point);
    geometry::SurfacePoint hit;
    scene_.world->intersect({&ray, 1}, {&hit, 1});
    const math::Point3 place_m = ray.origin_m + (hit.hit() ? hit.distance_m : kFarAway_m) * ray.direction;
    longest_px =
        std::max(longest_px, sensor::image_way_px(*camera_.flying(), place_m, exposure_s_).value_or(0.0));
  }
  return longest_px;
}

void FlownExposure::follow(std::vector<Dot> dots) {
  dots_ = std::move(dots);
  near_.clear();
  if (dots_.empty()) return;
  PixelBox all;
  for (Dot& dot : dots_) {
    // Ways are straight to a small part of a pixel; a dot alone holds where it is until half way to the next instant.
    dot.radius_px = dot.next ? 1.1 * dot.radius_px + 0.002 : dot.radius_px + 0.5 * apart_px_;
    all = all.with(box_of(dot));
  }
  first_x_ = all.x0, first_y_ = all.y0;
  columns_ = all.x1 - all.x0 + 1, rows_ = all.y1 - all.y0 + 1;
  near_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::size_t k = 0; k < dots_.size(); ++k) {
    const PixelBox box = box_of(dots_[k]);
    for (int y = box.y0; y <= box.y1; ++y)
      for (int x = box.x0; x <= box.x1; ++x)
        near_[static_cast<std::size_t>(y - first_y_) * static_cast<std::size_t>(columns_) +
              static_cast<std::size_t>(x - first_x_)]
            .push_back(static_cast<std::uint32_t>(k));
  }
}

template <class At>
void FlownExposure::visit_dots(const sampling::FocalPoint& point, const At& at) const {
  const double x = std::floor(point.x_px) - first_x_, y = std::floor(point.y_px) - first_y_;
  if (!(x >= 0.0) || !(y >= 0.0) || x >= columns_ || y >= rows_) return;
  for (const std::uint32_t k : near_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                                     static_cast<std::size_t>(x)]) {
    const Dot& dot = dots_[k];
    const sampling::FocalPoint next = dot.next.value_or(dot.at);
    const double dx = next.x_px - dot.at.x_px, dy = next.y_px - dot.at.y_px, way = dx * dx + dy * dy;
    const double to_x = point.x_px - dot.at.x_px, to_y = point.y_px - dot.at.y_px;
    const double share = way > 0.0 ? (to_x * dx + to_y * dy) / way : 0.5, on = std::clamp(share, 0.0, 1.0);
    at(dot, Passage{share, std::sqrt(way), std::hypot(to_x - share * dx, to_y - share * dy)},
       std::hypot(to_x - on * dx, to_y - on * dy));
  }
}

void FlownExposure::when_met(const sampling::FocalPoint& point) {
  crossed_.clear();
  const double apart_s = instants_s_[1] - instants_s_[0];
  sampling::FocalPoint middle = point;
  middle.time_s = 0.0;
  const double middle_s = dots_.empty() ? 0.0 : camera_.ray(middle).time_s;
  visit_dots(point, [&](const Dot& dot, const Passage& passage, double nearest_px) {
    if (nearest_px > dot.radius_px) return;
    const double at_s = middle_s + instants_s_[dot.instant];
    if (!dot.next) {
      crossed_.push_back({at_s - 0.5 * apart_s, at_s + 0.5 * apart_s});
      return;
    }
    // As long as it is within its radius.
    const double half_px =
        std::sqrt(std::max(0.0, dot.radius_px * dot.radius_px - passage.aside_px * passage.aside_px));
    const double half = passage.way_px > 0.0 ? std::min(half_px / passage.way_px, 1e6) : 1.0;
    crossed_.push_back({at_s + apart_s * std::clamp(passage.share - half, 0.0, 1.0),
                        at_s + apart_s * std::clamp(passage.share + half, 0.0, 1.0)});
  });
  when_crossed(point);
}

void FlownExposure::when_crossed(const sampling::FocalPoint& point) {
  const geometry::MovingWorld* const world = scene_.world->moving();
  if (world == nullptr) return;
  sampling::FocalPoint at = point;
  at.time_s = 0.0;
  const math::Ray middle = camera_.ray(at);
  geometry::SurfacePoint still;
  world->still().intersect({&middle, 1}, {&still, 1});
  at.time_s = instants_s_.front();
  math::Ray next = camera_.ray(at);
  for (std::size_t k = 0; k + 1 < instants_s_.size(); ++k) {
    const math::Ray last = next;
    at.time_s = instants_s_[k + 1];
    next = camera_.ray(at);
    at.time_s = 0.5 * (instants_s_[k] + instants_s_[k + 1]);
    const math::Ray between = camera_.ray(at);
    // A cone that holds the rays of that time, but for what is nearer than a metre.
    const double spread_rad = std::max(
        math::length(last.direction - between.direction) + math::length(last.origin_m - between.origin_m),
        math::length(next.direction - between.direction) + math::length(next.origin_m - between.origin_m));
    world->when_met(between, last.time_s, next.time_s, spread_rad, crossed_);
  }
  if (!still.hit() || !scene_.sun || !scene_.sun->is_up()) return;
  const math::Vec3 normal = still.geometric_normal.as_vector(), sun = scene_.sun->direction;
  const math::Vec3 outward = math::dot(normal, sun) < 0.0 ? -normal : normal;
  world->when_met(middle.onward(still.position_m + still.offset_m * outward, sun),
                  middle.time_s - 0.5 * exposure_s_, middle.time_s + 0.5 * exposure_s_,
                  scene_.sun->half_angle_rad, crossed_);
}

MovingCover::Times FlownExposure::times(const sampling::PathRequest& request) {
  when_met(request.point);
  sampling::FocalPoint middle = request.point;
  middle.time_s = 0.0;
  const double middle_s = camera_.ray(middle).time_s;
  MovingCover::Times times =
      MovingCover::drawn(crossed_, middle_s - 0.5 * exposure_s_, middle_s + 0.5 * exposure_s_, request);
  times.met_s -= middle_s, times.else_s -= middle_s;
  return times;
}

bool FlownExposure::crossed(const sampling::FocalPoint& point) {
  bool dotted = false;
  visit_dots(point, [&](const Dot& dot, const Passage&, double nearest_px) {
    dotted = dotted || nearest_px <= reach_px(dot);
  });
  if (dotted) return true;
  crossed_.clear();
  when_crossed(point);
  return !crossed_.empty();
}

}  // namespace ifov::render
