#include "thermal/surface_classes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/parallel.h"
#include "thermal/solid.h"

namespace ifov::thermal {
namespace {

constexpr int kTilts = 12, kAzimuths = 12;  // steps of half and of a whole turn
constexpr std::size_t kDirections = 2 + (kTilts - 1) * kAzimuths;
constexpr double kLeastRise_k = 0.1;            // of a surface that the Sun warms
constexpr double kLeastBend = 0.01;             // below it the kernels are one
constexpr double kLeastLeft = 0.01;             // of all weights: what is older meets nothing yet older
constexpr double kForgotten = 1e-4;             // of all weights: what is older is left out
constexpr double kGauss = 0.28867513459481287;  // 1 / sqrt(12)
constexpr int kSides = 4;                       // of the directions that tell what is coldest and hottest
// Of the largest rise, as the Sun may stand 33 degrees from the nearest of those, in front of a direction between them; and of
// what shade differs by among them, as the wind may.
constexpr double kBetween = 0.2;

math::Vec3 sun_of(const Outdoors& now) {
  const double level = std::cos(now.sun_elevation_rad);
  return {level * std::sin(now.sun_azimuth_rad), level * std::cos(now.sun_azimuth_rad),
          std::sin(now.sun_elevation_rad)};
}

math::Vec3 normal_of(double tilt_rad, double azimuth_rad) {
  return {std::sin(tilt_rad) * std::sin(azimuth_rad), std::sin(tilt_rad) * std::cos(azimuth_rad),
          std::cos(tilt_rad)};
}

}  // namespace

SurfaceClasses::SurfaceClasses(std::shared_ptr<const OutdoorsSeries> series, ClassSurface surface,
                               int threads, bool past_sky, double highest_m, bool neighbours)
    : series_(std::move(series)),
      surface_(std::move(surface)),
      levels_(surface_.stand.terrain),
      top_level_(static_cast<int>(std::ceil(levels_.place(highest_m)))),
      places_(kDirections * static_cast<std::size_t>(top_level_ + 1)) {
  const std::size_t count = series_->rows.size();
  if (past_sky)
    for (const Outdoors& now : series_->rows)
      of_free_sky_w_m2_.push_back(
          SurfaceBalance::of_free_sky_w_m2(now, surface_.skin, surface_.stand.ground_reflectance));
  for (std::size_t i = 0; i < count; ++i) {
    const Outdoors& now = series_->rows[i];
    if (!(now.direct_w_m2 > 0.0) || !(now.sun_elevation_rad > 0.0)) continue;
    rows_.push_back({i, sun_of(now), sun_of(series_->rows[i > 0 ? i - 1 : 0]),
                     sun_of(series_->rows[std::min(i + 1, count - 1)]),
                     surface_.skin.solar_absorptance * now.direct_w_m2});
  }
  if (neighbours) make_bins();
  // Up, down, and to four sides half and wholly upright, in the weakest wind and the strongest.
  constexpr std::array<int, 4> kRings{0, kTilts, kTilts / 4, kTilts / 2};
  constexpr int kBounding = 2 + 2 * kSides;
  std::vector<const Node*> bounding(static_cast<std::size_t>(top_level_ > 0 ? 2 * kBounding : kBounding));
  parallel_for(static_cast<std::int64_t>(bounding.size()), threads, [&](std::int64_t index) {
    const int k = static_cast<int>(index) % kBounding, level = index < kBounding ? 0 : top_level_;
    bounding[static_cast<std::size_t>(index)] =
        &node_at(k < 2 ? place_of(level, kRings[static_cast<std::size_t>(k)], 0)
                       : place_of(level, kRings[static_cast<std::size_t>(2 + (k - 2) / kSides)],
                                  (k - 2) % kSides * (kAzimuths / kSides)));
  });
  coldest_k_ = hottest_k_ = bounding[0]->shaded_k[0];
  for (std::size_t sky = 0; sky < 2; ++sky)
    middle_k_ += 0.5 * bounding[0]->shaded_k[sky] + 0.25 * bounding[0]->rise_k[sky];
  double warmest_shaded_k = coldest_k_, most_k = 0.0;
  for (const Node* node : bounding)
    for (std::size_t sky = 0; sky < 2; ++sky) {
      coldest_k_ = std::min(coldest_k_, node->shaded_k[sky]);
      warmest_shaded_k = std::max(warmest_shaded_k, node->shaded_k[sky]);
      hottest_k_ = std::max(hottest_k_, node->shaded_k[sky] + node->rise_k[sky]);
      most_k = std::max(most_k, node->rise_k[sky]);
    }
  const double of_shaded_k = kBetween * (warmest_shaded_k - coldest_k_);
  coldest_k_ -= of_shaded_k;
  hottest_k_ += of_shaded_k + kBetween * most_k;
}

void SurfaceClasses::solve(Node& node, double height_m, double tilt_rad, double azimuth_rad) const {
  Stand stand = surface_.stand;
  stand.height_m = height_m;
  stand.tilt_rad = tilt_rad;
  stand.azimuth_rad = azimuth_rad;
  const math::Vec3 normal = normal_of(tilt_rad, azimuth_rad);
  const auto solved = [&](double visibility) {
    return solve_surface(surface_.solid, surface_.skin, stand, *series_, surface_.start,
                         std::vector<double>(series_->rows.size(), visibility));
  };
  const auto last_k = [](const SurfaceSolution& solution) { return solution.history.nodes.back().surface_k; };
  if (!of_free_sky_w_m2_.empty()) {
    node.past_kernel.assign(series_->rows.size(), 0.0f);
    node.past_difference = node.past_kernel;
  }
  const auto gain_w_m2 = [&](const Row& row) { return row.absorbed_w_m2 * facing(normal, row.sun); };
  std::array<bool, 2> is_warmed{};
  Worths worths;
  node.first = rows_.size();
  for (std::size_t sky = 0; sky < 2; ++sky) {
    stand.free_sky = static_cast<double>(sky);
    const SurfaceSolution shaded = solved(0.0), sunlit = solved(1.0);
    node.shaded_k[sky] = last_k(shaded);
    node.rise_k[sky] = last_k(sunlit) - node.shaded_k[sky];
    const std::vector<double> at_shade = kernel_by_row(shaded), low = kernel_by_row(solved(0.5 - kGauss)),
                              high = kernel_by_row(solved(0.5 + kGauss)), at_sun = kernel_by_row(sunlit);
    const auto mean = [&](std::size_t row) { return 0.5 * (low[row] + high[row]); };
    const auto difference = [&](std::size_t row) { return at_sun[row] - at_shade[row]; };
    for (std::size_t row = 0; row < node.past_kernel.size(); ++row) {
      node.past_kernel[row] += static_cast<float>(0.25 * (at_shade[row] + at_sun[row]));
      node.past_difference[row] += static_cast<float>(0.5 * difference(row));
    }
    if (bins() > 0) keep_past(node, sky, shaded, sunlit, at_shade, at_sun);
    worths.kelvin[2 * sky] = node.shaded_k[sky];
    worths.kelvin[2 * sky + 1] = node.shaded_k[sky] + node.rise_k[sky];
    worths.worth_k[2 * sky] = std::accumulate(at_shade.begin(), at_shade.end(), 0.0);
    worths.worth_k[2 * sky + 1] = std::accumulate(at_sun.begin(), at_sun.end(), 0.0);
    double sum_k = 0.0, of_difference_k = 0.0;
    for (const Row& row : rows_) {
      node.kernel[sky].push_back(static_cast<float>(std::max(0.0, mean(row.index))));
      node.difference[sky].push_back(static_cast<float>(difference(row.index)));
      sum_k += static_cast<double>(node.kernel[sky].back()) * gain_w_m2(row);
      of_difference_k += static_cast<double>(node.difference[sky].back()) * gain_w_m2(row);
    }
    node.ratio[sky] = 1.0;
    double forgotten = 0.0;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      forgotten += kForgotten * static_cast<double>(node.kernel[sky][k]) * rows_[k].absorbed_w_m2;
    std::size_t first = 0;
    for (; first < rows_.size(); ++first)
      if (!((forgotten -= static_cast<double>(node.kernel[sky][first]) * rows_[first].absorbed_w_m2) > 0.0))
        break;
    node.first = std::min(node.first, first);
    if (!(sum_k > kLeastRise_k)) continue;
    if (std::abs(of_difference_k) > kLeastBend * sum_k)
      node.shift[sky] = std::clamp((node.rise_k[sky] - sum_k) / of_difference_k, -0.5, 0.5);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      float& kernel = node.kernel[sky][k];
      kernel = std::max(0.0f, kernel + static_cast<float>(node.shift[sky]) * node.difference[sky][k]);
    }
    is_warmed[sky] = true;
  }
  node.bend = bend_of(worths);
  for (std::size_t sky = 0; sky < 2; ++sky) {
    if (!is_warmed[sky]) continue;
    double shifted_k = 0.0;
    math::Vec3 towards_sun{};
    for (std::size_t k = node.first; k < rows_.size(); ++k) {
      const double weight_k = static_cast<double>(node.kernel[sky][k]) * gain_w_m2(rows_[k]);
      shifted_k += weight_k;
      towards_sun = towards_sun + weight_k * rows_[k].sun;
    }
    node.ratio[sky] = node.rise_k[sky] / shifted_k;
    const double together = math::length(towards_sun) / shifted_k;
    node.sun_spread = std::max(node.sun_spread, std::sqrt(std::max(0.0, 1.0 - together * together)));
  }
}

double SurfaceClasses::time_s(std::size_t row, double steps) const {
  // The last row's half-step after it is not there: what it stands for lies before it.
  const double before = static_cast<double>(rows() - 1 - row);
  return -step_s() * (before > 0.0 ? before - steps : std::abs(steps));
}

math::Vec3 SurfaceClasses::sun_at(std::size_t row, double steps) const {
  const Row& of = rows_[row];
  if (of.index + 1 == rows()) steps = -std::abs(steps);  // as time_s()
  const math::Vec3& other = steps < 0.0 ? of.before : of.after;
  const math::Vec3 between = (1.0 - std::abs(steps)) * of.sun + std::abs(steps) * other;
  return math::normalized(between);
}

std::size_t SurfaceClasses::place_of(int level, int ring, int azimuth) {
  const std::size_t direction = ring == 0 ? 0
                                : ring == kTilts
                                    ? 1
                                    : static_cast<std::size_t>(2 + (ring - 1) * kAzimuths + azimuth);
  return kDirections * static_cast<std::size_t>(level) + direction;
}

const SurfaceClasses::Node& SurfaceClasses::node_at(std::size_t number) const {
  Place& place = places_[number];
  if (!place.solved.load(std::memory_order_acquire))
    std::call_once(place.once, [&] {
      const int direction = static_cast<int>(number % kDirections), in_rings = direction - 2;
      const int ring = direction == 0 ? 0 : direction == 1 ? kTilts : 1 + in_rings / kAzimuths;
      solve(place.node, levels_.height_m(static_cast<int>(number / kDirections)), ring * kTiltStep_rad,
            direction < 2 ? 0.0 : in_rings % kAzimuths * kAzimuthStep_rad);
      place.solved.store(true, std::memory_order_release);
    });
  return place.node;
}

SurfaceClasses::Turn SurfaceClasses::turn_of(math::Vec3 normal) {
  const double tilt = std::acos(std::clamp(normal.z, -1.0, 1.0)) / kTiltStep_rad;
  Turn found;
  found.ring = std::clamp(static_cast<int>(tilt), 0, kTilts - 1);
  double turn = std::atan2(normal.x, normal.y) / kAzimuthStep_rad;
  if (turn < 0.0) turn += kAzimuths;
  found.azimuth = std::clamp(static_cast<int>(turn), 0, kAzimuths - 1);
  found.up = std::clamp(tilt - found.ring, 0.0, 1.0);
  found.east = std::clamp(turn - found.azimuth, 0.0, 1.0);
  return found;
}

SurfaceClasses::AboveLevel SurfaceClasses::level_of(double height_m) const {
  const double wind = top_level_ > 0 ? levels_.place(height_m) : 0.0;
  const int level = std::clamp(static_cast<int>(wind), 0, std::max(0, top_level_ - 1));
  return {level, std::clamp(wind - level, 0.0, 1.0)};
}

std::array<SurfaceClasses::Corner, 4> SurfaceClasses::corners_at(const Turn& turn, int level, double share) {
  std::array<Corner, 4> found;
  std::size_t count = 0;
  constexpr double kRounding = 1e-9;  // a wall is not solved for what leans by less
  const auto add = [&](int ring, double of_level) {
    const auto one = [&](int azimuth, double of_ring) {
      if (of_level * of_ring > kRounding)
        found[count++] = {nullptr, of_level * of_ring, place_of(level, ring, azimuth)};
    };
    if (ring % kTilts == 0) return one(0, 1.0);
    one(turn.azimuth, 1.0 - turn.east);
    one((turn.azimuth + 1) % kAzimuths, turn.east);
  };
  add(turn.ring, share * (1.0 - turn.up));
  add(turn.ring + 1, share * turn.up);
  return found;
}

SurfaceClasses::Corners SurfaceClasses::corners(const Pose& pose) const {
  const Turn turn = turn_of(pose.normal);
  const AboveLevel above = level_of(pose.height_m);
  Corners found;
  const auto add = [&](int level, double share) {
    for (const Corner& corner : corners_at(turn, level, share)) {
      if (!(corner.share > 0.0)) break;
      found.all[found.count] = corner;
      found.all[found.count++].node = &node_at(corner.place);
    }
  };
  add(above.level, 1.0 - above.stronger);
  if (above.stronger > 0.0) add(above.level + 1, above.stronger);
  return found;
}

SurfaceClasses::Corners SurfaceClasses::any_corner(const Pose& pose, double by_chance) const {
  const Turn turn = turn_of(pose.normal);
  const AboveLevel above = level_of(pose.height_m);
  const auto is_next = [&](double share) {
    const bool next = by_chance < share;
    by_chance = next ? by_chance / share : (by_chance - share) / (1.0 - share);
    return next ? 1 : 0;
  };
  const int level = above.level + is_next(above.stronger), ring = turn.ring + is_next(turn.up);
  const int azimuth = ring % kTilts == 0 ? 0 : (turn.azimuth + is_next(turn.east)) % kAzimuths;
  Corners found;
  found.count = 1;
  found.all[0].place = place_of(level, ring, azimuth);
  found.all[0].share = 1.0;
  found.all[0].node = &node_at(found.all[0].place);
  return found;
}

std::size_t SurfaceClasses::first_row(const Corners& at) const {
  std::size_t first = rows_.size();
  for (const Corner& corner : at) first = std::min(first, corner.node->first);
  return first;
}

void SurfaceClasses::bends(const Pose& pose, std::span<const double> sum_k,
                           std::span<double> per_pair) const {
  const Corners at = corners(pose);
  const std::size_t first = first_row(at);
  std::fill_n(per_pair.begin(), first, 0.0);
  bends(at, sum_k.subspan(first), per_pair.subspan(first));
}

SurfaceClasses::Shade SurfaceClasses::shaded(const Pose& pose, double free_sky,
                                             std::span<double> weight_k) const {
  const Corners at = corners(pose);
  const std::size_t first = first_row(at);
  std::fill_n(weight_k.begin(), first, 0.0);
  return shaded(at, pose.normal, free_sky, weight_k.subspan(first));
}

SurfaceClasses::AtStake SurfaceClasses::at_stake(const Corners& at) const {
  AtStake found;
  for (const Corner& corner : at) {
    const Node& node = *corner.node;
    found.of_sky_k += corner.share * (node.shaded_k[1] - node.shaded_k[0]);
    found.sun_spread += corner.share * node.sun_spread;
    found.rise_k += corner.share * 0.5 * (node.rise_k[0] + node.rise_k[1]);
  }
  return found;
}

void SurfaceClasses::bends(const Corners& at, std::span<const double> sum_k,
                           std::span<double> per_pair) const {
  static thread_local std::vector<double> kernel, bent;
  const std::size_t count = sum_k.size(), first = rows_.size() - count;
  kernel.assign(count, 0.0);
  bent.assign(count, 0.0);
  for (const Corner& corner : at) {
    const Node& node = *corner.node;
    for (std::size_t sky = 0; sky < 2; ++sky) {
      const double shift = node.shift[sky], factor = 0.5 * corner.share * (1.0 + 2.0 * shift);
      const float* const of_node = node.kernel[sky].data() + first;
      const float* const difference = node.difference[sky].data() + first;
      for (std::size_t k = 0; k < count; ++k) {
        kernel[k] += 0.5 * corner.share * static_cast<double>(of_node[k]);
        bent[k] += factor * static_cast<double>(difference[k]);
      }
    }
  }
  const double least_k = count == 0 ? 0.0 : kLeastLeft * sum_k.back();
  double bend = 0.0, last = 0.0, q = 0.0;
  for (std::size_t k = count; k-- > 0; last = bend) {
    if (kernel[k] > 0.0) bend = std::clamp(bent[k] / kernel[k], -1.0, 1.0);
    if (sum_k[k] > least_k) q += (bend - last) / sum_k[k];
    per_pair[k] = q;
  }
}

SurfaceClasses::Shade SurfaceClasses::shaded(const Corners& at, math::Vec3 normal, double free_sky,
                                             std::span<double> weight_k) const {
  Shade shade;
  const std::size_t count = weight_k.size(), first = rows_.size() - count;
  std::fill(weight_k.begin(), weight_k.end(), 0.0);
  for (const Corner& corner : at) {
    const Node& node = *corner.node;
    shade.kelvin += corner.share * std::lerp(node.shaded_k[0], node.shaded_k[1], free_sky);
    shade.of_sky_k += corner.share * (node.shaded_k[1] - node.shaded_k[0]);
    const double factor = corner.share * std::lerp(node.ratio[0], node.ratio[1], free_sky);
    const double of_hidden = factor * (1.0 - free_sky), of_free = factor * free_sky;
    const float* const hidden = node.kernel[0].data() + first;
    const float* const free = node.kernel[1].data() + first;
    double* __restrict sum = weight_k.data();
    for (std::size_t k = 0; k < count; ++k)
      sum[k] += of_hidden * static_cast<double>(hidden[k]) + of_free * static_cast<double>(free[k]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Row& row = rows_[first + k];
    weight_k[k] *= row.absorbed_w_m2 * facing(normal, row.sun);
  }
  return shade;
}

void SurfaceClasses::past_sky(const Pose& pose, std::span<double> weight_k, std::span<double> bend_k) const {
  const double open = open_share(pose.normal);
  std::fill(weight_k.begin(), weight_k.end(), 0.0);
  std::fill(bend_k.begin(), bend_k.end(), 0.0);
  for (const Corner& corner : corners(pose))
    for (std::size_t row = 0; row < weight_k.size(); ++row) {
      const double difference = static_cast<double>(corner.node->past_difference[row]);
      weight_k[row] += corner.share * (static_cast<double>(corner.node->past_kernel[row]) - 0.5 * difference);
      bend_k[row] += corner.share * difference;
    }
  for (std::size_t row = 0; row < weight_k.size(); ++row) {
    weight_k[row] *= open * of_free_sky_w_m2_[row];
    bend_k[row] *= open * of_free_sky_w_m2_[row];
  }
}

}  // namespace ifov::thermal
