// What a surface was before, and what it would have gained then is worth now: by which surfaces warm each other.
#include <algorithm>
#include <cmath>

#include "thermal/faces/sky_longwave.h"
#include "thermal/surface_classes.h"

namespace ifov::thermal {
namespace {

constexpr double kLongestBin_s = 1800.0;
constexpr std::size_t kShareOfLag = 6;
// Of drawing rows by night, and what their global irradiance adds, W m-2: about what surfaces send more or less than the ground.
constexpr double kOfNight_w_m2 = 20.0, kOfLight = 0.15;

constexpr double kApart_k = 4.0;

double light_of(const Outdoors& now) {
  return kOfNight_w_m2 +
         kOfLight * (now.diffuse_w_m2 + now.direct_w_m2 * std::max(0.0, std::sin(now.sun_elevation_rad)));
}

std::size_t found_in(const std::vector<float>& sums, double by_chance) {
  const auto at = std::upper_bound(sums.begin(), sums.end() - 1, static_cast<float>(by_chance) * sums.back());
  return static_cast<std::size_t>(at - sums.begin());
}

}  // namespace

void SurfaceClasses::make_bins() {
  const std::size_t count = rows();
  const auto longest =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kLongestBin_s / step_s())));
  past_.sunlit.assign(count, -1);
  for (std::size_t k = 0; k < rows_.size(); ++k) past_.sunlit[rows_[k].index] = static_cast<std::int32_t>(k);
  for (std::size_t lag = 0; lag < count;) {
    past_.begin.push_back(lag);
    const std::size_t width = std::min(std::clamp<std::size_t>(lag / kShareOfLag, 1, longest), count - lag);
    past_.light.push_back(0.0);
    for (std::size_t k = 0; k < width; ++k, ++lag) {
      past_.of_lag.push_back(static_cast<std::uint16_t>(past_.begin.size() - 1));
      past_.light.back() += light_of(series_->rows[count - 1 - lag]) / static_cast<double>(width);
    }
  }
  past_.begin.push_back(count);
}

SurfaceClasses::BinRows SurfaceClasses::rows_of_bin(std::size_t bin) const {
  return {rows() - 1 - past_.begin[bin], past_.begin[bin + 1] - past_.begin[bin]};
}

void SurfaceClasses::keep_past(Node& node, std::size_t sky, const SurfaceSolution& shaded,
                               const SurfaceSolution& sunlit, std::span<const double> at_shade,
                               std::span<const double> at_sun) const {
  node.then_k.resize(bins());
  node.worth.resize(bins());
  node.worth_of_sun.resize(bins());
  for (std::size_t bin = 0; bin < bins(); ++bin) {
    const auto [first, count] = rows_of_bin(bin);
    const std::size_t middle = first - count / 2;
    node.then_k[bin][sky] = static_cast<float>(shaded.surface_k(middle));
    node.then_k[bin][2 + sky] = static_cast<float>(sunlit.surface_k(middle) - shaded.surface_k(middle));
    for (std::size_t row = first + 1 - count; row <= first; ++row) {
      node.worth[bin] += static_cast<float>(0.5 * at_shade[row]);
      node.worth_of_sun[bin] += static_cast<float>(0.5 * (at_sun[row] - at_shade[row]));
    }
  }
  if (sky == 0) return;
  float drawn = 0.0f, lagged = 0.0f;
  for (std::size_t bin = 0; bin < bins(); ++bin) {
    const float of = std::max(0.0f, node.worth[bin] + 0.5f * node.worth_of_sun[bin]);
    node.drawn.push_back(drawn += of * static_cast<float>(past_.light[bin]));
    node.lagged.push_back(lagged += of);
  }
}

const SurfaceClasses::Corner& SurfaceClasses::corner_by(const Corners& corners, double by_chance) const {
  const Corner* corner = corners.begin();
  for (; corner + 1 < corners.end(); ++corner)
    if ((by_chance -= corner->share) < 0.0) break;
  return *corner;
}

SurfaceClasses::PastRow SurfaceClasses::draw_past(const Corners& at, std::array<double, 3> by_chance) const {
  const Node& node = *corner_by(at, by_chance[0]).node;
  const std::size_t bin = found_in(node.drawn, by_chance[1]);
  const double chance = static_cast<double>(node.drawn[bin] - (bin > 0 ? node.drawn[bin - 1] : 0.0f)) /
                        static_cast<double>(node.drawn.back());
  const auto [first, count] = rows_of_bin(bin);
  PastRow found{first -
                std::min(count - 1, static_cast<std::size_t>(by_chance[2] * static_cast<double>(count)))};
  if (!(chance > 0.0)) return found;
  found.in_shade_k = static_cast<double>(node.worth[bin]) / chance;
  found.of_sun_k = static_cast<double>(node.worth_of_sun[bin]) / chance;
  return found;
}

std::size_t SurfaceClasses::draw_past(std::span<const SurfaceClasses* const> by_time, const Pose& pose,
                                      std::array<double, 4> by_chance, std::span<PastRow> found) {
  const auto drawn = std::min(by_time.size() - 1,
                              static_cast<std::size_t>(by_chance[3] * static_cast<double>(by_time.size())));
  const SurfaceClasses& of = *by_time[drawn];
  const std::size_t place = of.corner_by(of.corners(pose), by_chance[0]).place;
  const std::size_t bin = found_in(of.node_at(place).drawn, by_chance[1]);
  const auto [first, count] = of.rows_of_bin(bin);
  const std::size_t row =
      first - std::min(count - 1, static_cast<std::size_t>(by_chance[2] * static_cast<double>(count)));
  double chance = 0.0;
  for (std::size_t t = 0; t < by_time.size(); ++t) {
    const SurfaceClasses& one = *by_time[t];
    found[t] = {row};
    const double at =
        static_cast<double>(row) + std::round((of.series_->begin_s - one.series_->begin_s) / of.step_s());
    if (at < 0.0 || at >= static_cast<double>(one.rows())) continue;
    const std::size_t then = one.bin_of_row(static_cast<std::size_t>(at));
    const Node& node = one.node_at(place);
    const double rows = static_cast<double>(one.rows_of_bin(then).count);
    chance += static_cast<double>(node.drawn[then] - (then > 0 ? node.drawn[then - 1] : 0.0f)) /
              (static_cast<double>(node.drawn.back()) * rows * static_cast<double>(by_time.size()));
    found[t].in_shade_k = static_cast<double>(node.worth[then]) / rows;
    found[t].of_sun_k = static_cast<double>(node.worth_of_sun[then]) / rows;
  }
  for (std::size_t t = 0; t < by_time.size(); ++t) {
    found[t].in_shade_k = chance > 0.0 ? found[t].in_shade_k / chance : 0.0;
    found[t].of_sun_k = chance > 0.0 ? found[t].of_sun_k / chance : 0.0;
  }
  return drawn;
}

std::size_t SurfaceClasses::draw_lag(const Corners& at, double which, double how_long) const {
  const Node& node = *corner_by(at, which).node;
  const std::size_t bin = found_in(node.lagged, how_long);
  const float before = bin > 0 ? node.lagged[bin - 1] : 0.0f, with = node.lagged[bin];
  const double count = static_cast<double>(past_.begin[bin + 1] - past_.begin[bin]);
  const double within =
      std::clamp((how_long * static_cast<double>(node.lagged.back()) - static_cast<double>(before)) /
                     std::max(1e-30, static_cast<double>(with - before)),
                 0.0, 1.0);
  return past_.begin[bin] + static_cast<std::size_t>(std::min(count - 1.0, within * count));
}

void SurfaceClasses::worth(const Pose& pose, std::span<double> in_shade_k, std::span<double> of_sun_k) const {
  std::fill(in_shade_k.begin(), in_shade_k.end(), 0.0);
  std::fill(of_sun_k.begin(), of_sun_k.end(), 0.0);
  for (const Corner& corner : corners(pose))
    for (std::size_t bin = 0; bin < bins(); ++bin) {
      in_shade_k[bin] += corner.share * static_cast<double>(corner.node->worth[bin]);
      of_sun_k[bin] += corner.share * static_cast<double>(corner.node->worth_of_sun[bin]);
    }
}

double SurfaceClasses::worth_of_all_k(const Corners& at) const {
  double sum_k = 0.0;
  for (const Corner& corner : at) sum_k += corner.share * static_cast<double>(corner.node->lagged.back());
  return sum_k;
}

double SurfaceClasses::bend_of(const Worths& worths) const {
  double kelvin = 0.0, worth_k = 0.0, squares_k2 = 0.0, products = 0.0;
  for (std::size_t k = 0; k < worths.kelvin.size(); ++k) {
    kelvin += 0.25 * worths.kelvin[k];
    worth_k += 0.25 * worths.worth_k[k];
  }
  for (std::size_t k = 0; k < worths.kelvin.size(); ++k) {
    const double off_k = worths.kelvin[k] - kelvin;
    squares_k2 += off_k * off_k;
    products += off_k * (worths.worth_k[k] - worth_k);
  }
  // What they emit alone bends at least; where all come to about the same, nothing else is known, and far from them the slope between
  // them says little.
  const double emitted = worth_k * 6.0 * surface_.skin.faces() * surface_.skin.emissivity *
                         kStefanBoltzmann_w_m2_k4 * kelvin * kelvin;
  if (!(worth_k > 0.0)) return 0.0;
  return std::max(emitted, -0.5 * products / (worth_k * (squares_k2 + kApart_k * kApart_k)));
}

double SurfaceClasses::bend_of_gain(const Corners& at) const {
  double bend = 0.0;
  for (const Corner& corner : at) bend += corner.share * corner.node->bend;
  return bend;
}

SurfaceClasses::Then SurfaceClasses::then(const Corners& at, double free_sky, std::size_t bin) const {
  Then found;
  for (const Corner& corner : at) {
    const std::array<float, 4>& then_k = corner.node->then_k[bin];
    const auto between = [&](std::size_t of) {
      return std::lerp(static_cast<double>(then_k[of]), static_cast<double>(then_k[of + 1]), free_sky);
    };
    found.shaded_k += corner.share * between(0);
    found.rise_k += corner.share * between(2);
  }
  return found;
}

double SurfaceClasses::more_than_ground_w_m2(const FromBeside& comes, std::size_t row) const {
  const FromBeside ground = from_ground(row);
  return surface_.skin.solar_absorptance * (comes.sunlight_w_m2 - ground.sunlight_w_m2) +
         surface_.skin.emissivity * (comes.longwave_w_m2 - ground.longwave_w_m2);
}

}  // namespace ifov::thermal
