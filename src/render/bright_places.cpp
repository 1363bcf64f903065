#include "render/bright_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "radiometry/spectral_nodes.h"
#include "sensor/camera.h"
#include "transport/path_record.h"
#include "transport/shining_parts.h"
#include "transport/spectral_scene.h"
#include "transport/view_atmosphere.h"

namespace ifov::render {

namespace {

/// What is larger is met by a pixel's own points.
constexpr double kSmall_px = 1.0;
/// As far away as this all places of a scene and its sensor are one.
constexpr double kAsFar_m = 1e13;

/// Which surface assignments outshine the rest where the sensor is, behind the air. In channels to which no light of the Sun comes
/// through the air a leaf that is a little warmer than others outshines them, and the sensor sees neither.
class SeenToShine {
 public:
  SeenToShine(const transport::SpectralScene& scene, const transport::ShiningParts& shining)
      : scene_(scene), air_(scene), shining_(shining) {}

  /// As the first of its parts that is asked about is seen, along `ray`.
  bool operator()(const transport::ShiningParts::Part& part, const math::Ray& ray) {
    const auto [known, fresh] = known_.try_emplace(part.assignment, true);
    if (fresh) known->second = contrast(part, ray) > transport::ShiningParts::kContrast;
    return known->second;
  }

 private:
  double contrast(const transport::ShiningParts::Part& part, const math::Ray& ray) const {
    transport::PathRecord::Path path;
    path.towards_sensor = -ray.direction;
    path.sensor_height_m = ray.origin_m.z;
    path.met = true;
    path.seen_height_m = part.ball.centre_m.z;
    path.seen_x_m = part.ball.centre_m.x, path.seen_y_m = part.ball.centre_m.y;
    radiometry::SpectrumBlock rows(2, scene_.node_count());
    std::fill_n(rows.row(0), scene_.stride(), 0.0f);
    air_.apply(path, rows.row(0));
    air_.transmittance(path, rows.row(1));
    const radiometry::SpectralNodes& nodes = scene_.nodes();
    std::vector<float> added(nodes.channel_count()), left(nodes.channel_count());
    nodes.to_channels(rows.row(0), added.data());
    nodes.to_channels(rows.row(1), left.data());
    const std::span<const double> highest = shining_.highest(part.assignment), usual = shining_.usual();
    double most = 0.0;
    for (std::size_t c = 0; c < left.size(); ++c) {
      const double own = static_cast<double>(left[c]) * highest[c],
                   rest = static_cast<double>(left[c]) * usual[c] + static_cast<double>(added[c]);
      if (own > most * rest) most = rest > 0.0 ? own / rest : std::numeric_limits<double>::infinity();
    }
    return most;
  }

  const transport::SpectralScene& scene_;
  transport::ViewAtmosphere air_;
  const transport::ShiningParts& shining_;
  std::map<std::uint32_t, bool> known_;  // by surface assignment
};

}  // namespace

sampling::BrightPlaces bright_places(const transport::SpectralScene& scene, const sensor::Camera& camera,
                                     std::span<const WingSpots::Box> others,
                                     std::span<const math::Vec3> glare, double half_angle_rad) {
  std::vector<WingSpots::Box> boxes;
  const auto add = [&](const std::optional<WingSpots::Box>& box) {
    if (box && 2.0 * std::max(box->half_width_px, box->half_height_px) <= kSmall_px) boxes.push_back(*box);
  };
  for (const WingSpots::Box& box : others) add(box);
  for (const math::Vec3 direction : glare)
    add(WingSpots::about(math::Point3{} + kAsFar_m * direction, kAsFar_m * std::tan(half_angle_rad), camera));
  const transport::ShiningParts shining(scene);
  SeenToShine seen_to_shine(scene, shining);
  for (const transport::ShiningParts::Part& part : shining.parts()) {
    std::optional<WingSpots::Box> box = WingSpots::about(part.ball.centre_m, part.ball.radius_m, camera);
    if (!box) continue;
    math::Ray ray;
    camera.rays({&box->centre, 1}, {&ray, 1});
    if (!seen_to_shine(part, ray)) continue;
    box->strength = part.contrast * part.fill * box->area_px2();
    add(box);
  }
  if (boxes.size() > WingSpots::kMost) {
    std::stable_sort(boxes.begin(), boxes.end(), [](const WingSpots::Box& a, const WingSpots::Box& b) {
      return a.strength > b.strength;
    });
    boxes.resize(WingSpots::kMost);
  }
  std::vector<sampling::BrightPlaces::Box> places;
  for (const WingSpots::Box& box : boxes)
    places.push_back({box.centre, box.half_width_px, box.half_height_px, box.brightest});
  return sampling::BrightPlaces(places);
}

}  // namespace ifov::render
