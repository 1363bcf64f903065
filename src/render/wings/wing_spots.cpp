#include "render/wings/wing_spots.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sampling/random.h"
#include "sampling/value_batch.h"
#include "sensor/camera.h"
#include "transport/shining_parts.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

constexpr std::uint64_t kSpotPaths = 0x73706f74ull, kSpotPosition = 0x73706f73ull,
                        kSpotBrightest = 0x73706f62ull;  // of random numbers
/// The box of a ball's image is so much larger than it.
constexpr double kMargin = 1.05, kRounding_px = 1e-6;

std::uint64_t key_of(int x, int y) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
}
int box_pixel(double x_px) { return static_cast<int>(std::floor(x_px)); }

/// Cuts it into equal boxes that are small enough.
void add_parts(const WingSpots::Box& box, std::vector<WingSpots::Box>& boxes) {
  const auto parts = [](double half_px) {
    return std::max(1, static_cast<int>(std::ceil(2.0 * half_px / WingSpots::kLargest_px)));
  };
  const int columns = parts(box.half_width_px), rows = parts(box.half_height_px);
  WingSpots::Box part = box;
  part.half_width_px /= columns;
  part.half_height_px /= rows;
  part.across = std::max(2, box.across / std::max(columns, rows) / 2 * 2);
  part.strength /= columns * rows;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      part.centre.x_px = box.centre.x_px + (2 * i + 1 - columns) * part.half_width_px;
      part.centre.y_px = box.centre.y_px + (2 * j + 1 - rows) * part.half_height_px;
      boxes.push_back(part);
    }
}

}  // namespace

WingSpots::WingSpots(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    const Box& box = boxes_[k];
    for (int y = box_pixel(box.centre.y_px - box.half_height_px);
         y <= box_pixel(box.centre.y_px + box.half_height_px); ++y)
      for (int x = box_pixel(box.centre.x_px - box.half_width_px);
           x <= box_pixel(box.centre.x_px + box.half_width_px); ++x)
        by_pixel_[key_of(x, y)].push_back(static_cast<std::uint32_t>(k));
  }
}

std::optional<WingSpots::Box> WingSpots::about(math::Point3 centre_m, double radius_m,
                                               const sensor::Camera& camera) {
  Box box{};
  if (!camera.project(centre_m, box.centre)) return {};
  double x = 0.0, y = 0.0;
  for (const math::Vec3 axis : {math::Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}) {
    sampling::FocalPoint end;
    if (!camera.project(centre_m + radius_m * axis, end)) return {};
    x = std::hypot(x, end.x_px - box.centre.x_px);
    y = std::hypot(y, end.y_px - box.centre.y_px);
  }
  box.half_width_px = kMargin * x + kRounding_px;
  box.half_height_px = kMargin * y + kRounding_px;
  const auto near = [](double at_px, int pixels) {
    return at_px > -kOutside_px && at_px < pixels + kOutside_px;
  };
  if (!near(box.centre.x_px, camera.width_px()) || !near(box.centre.y_px, camera.height_px())) return {};
  return box;
}

WingSpots WingSpots::find(const transport::SpectralScene& scene, const sensor::Camera& camera,
                          std::vector<Box> others) {
  const transport::ShiningParts parts(scene);
  std::vector<Box> boxes = std::move(others);
  for (const transport::ShiningParts::Part& part : parts.parts()) {
    const std::optional<Box> seen = about(part.ball.centre_m, part.ball.radius_m, camera);
    if (!seen) continue;
    Box box = *seen;
    box.across = 16;
    if (2.0 * std::max(box.half_width_px, box.half_height_px) > kMet_px) continue;
    box.strength = part.contrast * part.fill * box.area_px2();
    add_parts(box, boxes);
  }
  if (boxes.size() > kMost) {
    std::stable_sort(boxes.begin(), boxes.end(),
                     [](const Box& a, const Box& b) { return a.strength > b.strength; });
    boxes.resize(kMost);
  }
  // So that many cost no more than some: their errors average out.
  const int most_across = boxes.size() > 16384 ? 2 : boxes.size() > 2048 ? 4 : boxes.size() > 256 ? 8 : 16;
  for (Box& box : boxes) box.across = std::min(box.across, most_across);
  return WingSpots(std::move(boxes));
}

std::uint32_t WingSpots::first_at(sampling::FocalPoint point) const {
  const auto found = by_pixel_.find(key_of(box_pixel(point.x_px), box_pixel(point.y_px)));
  if (found == by_pixel_.end()) return kNone;
  for (const std::uint32_t k : found->second)
    if (boxes_[k].holds(point)) return k;
  return kNone;
}

SpotLight::SpotLight(const WingSpots& where, std::uint64_t seed, const CancelToken* cancel,
                     sampling::Field& field)
    : where_(where) {
  const std::size_t columns = static_cast<std::size_t>(field.columns());
  std::vector<sampling::FocalPoint> points;
  std::vector<float> values;
  std::vector<unsigned char> counts;
  std::vector<double> light(columns), variance(columns);
  for (std::uint32_t number = 0; number < where.boxes().size(); ++number) {
    const WingSpots::Box& box = where.boxes()[number];
    const std::size_t across = static_cast<std::size_t>(box.across), paths = across * across;
    points.resize(paths);
    values.resize(paths * columns);
    counts.resize(paths);
    // Two by two in neighbouring strata, for the error.
    sampling::for_each_value(
        field, cancel, paths,
        [&](std::size_t k) {
          const std::size_t block = k / 4, quarter = k % 4, blocks = across / 2;
          const std::uint64_t key = sampling::hash(seed, number, k, kSpotPosition);
          const double u =
              static_cast<double>(2 * (block % blocks) + quarter % 2) + sampling::unit_double(key);
          const double v =
              static_cast<double>(2 * (block / blocks) + quarter / 2) + sampling::unit_double(key + 1);
          points[k] = {box.centre.x_px + box.half_width_px * (2.0 * u / box.across - 1.0),
                       box.centre.y_px + box.half_height_px * (2.0 * v / box.across - 1.0)};
          return sampling::PathRequest{points[k], sampling::hash(seed, number, kSpotPaths),
                                       static_cast<std::uint32_t>(k)};
        },
        [&](std::size_t k, sampling::Label, const float* found) {
          counts[k] = where.first_at(points[k]) == number;
          for (std::size_t c = 0; c < columns; ++c)
            values[k * columns + c] = counts[k] != 0 ? found[c] : 0.0f;
        });

    Spot spot;
    const double area = box.area_px2() / static_cast<double>(paths);  // of one path
    light.assign(columns, 0.0);
    variance.assign(columns, 0.0);
    for (std::size_t k = 0; k < paths; ++k) spot.area_px2 += counts[k] != 0 ? area : 0.0;
    double x = 0.0, y = 0.0, weight = 0.0;
    for (std::size_t c = 0; c < columns; ++c) {
      float least = std::numeric_limits<float>::infinity();
      for (std::size_t k = 0; k < paths; ++k) {
        light[c] += area * static_cast<double>(values[k * columns + c]);
        if (counts[k] != 0) least = std::min(least, values[k * columns + c]);
      }
      for (std::size_t k = 0; k < paths; k += 4) {
        const float* const v = values.data() + k * columns + c;
        const double bend =
            static_cast<double>(v[0]) - v[columns] - v[2 * columns] + static_cast<double>(v[3 * columns]);
        variance[c] += area * area * bend * bend;
      }
      for (std::size_t k = 0; k < paths; ++k) {
        if (counts[k] == 0) continue;
        const double more = values[k * columns + c] - least;
        weight += more;
        x += more * points[k].x_px;
        y += more * points[k].y_px;
      }
    }
    spot.middle = weight > 0.0 ? sampling::FocalPoint{x / weight, y / weight} : box.centre;
    spot.light.assign(light.begin(), light.end());
    spot.variance.assign(variance.begin(), variance.end());
    if (box.brightest) spot.unmet = unmet(number, values, area, seed, field);
    if (spot.area_px2 > 0.0) spots_.push_back(std::move(spot));
  }
}

std::vector<float> SpotLight::unmet(std::uint32_t number, std::span<const float> met, double area_px2,
                                    std::uint64_t seed, sampling::Field& field) const {
  // Of what is larger than three strata, one path of 16 x 16 misses all with a probability of 5 % at most.
  constexpr double kStrata = 3.0;
  const WingSpots::Box& box = where_.boxes()[number];
  const std::size_t columns = static_cast<std::size_t>(field.columns());
  const sampling::PathRequest request{*box.brightest, sampling::hash(seed, number, kSpotBrightest), 0};
  sampling::Label label;
  std::vector<float> value(static_cast<std::size_t>(field.stride())), left(columns);
  field.values({&request, 1}, {&label, 1}, value);
  for (std::size_t c = 0; c < columns; ++c) {
    float most = 0.0f;
    for (std::size_t k = 0; k < met.size(); k += columns) most = std::max(most, met[k + c]);
    // Paths that met the like of it know how large it is.
    if (most < 0.5f * value[c]) left[c] = static_cast<float>(kStrata * area_px2) * (value[c] - most);
  }
  return left;
}

void SpotLight::add(std::vector<Spot> apart) {
  spots_.insert(spots_.end(), std::make_move_iterator(apart.begin()), std::make_move_iterator(apart.end()));
}

}  // namespace ifov::render
