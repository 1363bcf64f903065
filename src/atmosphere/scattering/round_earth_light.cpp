#include "atmosphere/scattering/round_earth_light.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/scattering/layer_cuts.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/scattering/shell_orders.h"
#include "math/angle.h"

namespace ifov::atmosphere {
namespace {

/// Steps between the Sun's angles and how far they go: lines of sight run over a few degrees of the Earth, and where the Sun
/// is low light changes by much in each.
struct Steps {
  double step_rad;
  int below, above;
};
Steps steps_for(double sun_zenith_rad) {
  if (sun_zenith_rad < 70.0 * math::kDegree) return {2.5 * math::kDegree, 1, 1};
  if (sun_zenith_rad < 76.0 * math::kDegree) return {1.5 * math::kDegree, 2, 2};
  if (sun_zenith_rad < 87.0 * math::kDegree) return {1.0 * math::kDegree, 4, 4};
  return {1.0 * math::kDegree, 8, 6};
}

/// Where haze or clouds scatter more than molecules do, light in them falls to a tenth within a quarter of a degree of sunset: there
/// steps are eighths.
std::vector<double> angles_about(double sun_zenith_rad, bool finely, std::size_t& own) {
  constexpr double kFirst_rad = 88.9 * math::kDegree, kLast_rad = 91.1 * math::kDegree,
                   kSet_rad = 90.75 * math::kDegree;  // from there on nothing sees it rise
  finely = finely && sun_zenith_rad < kSet_rad;
  constexpr int kParts = 8, kFar = 1;
  const Steps steps = steps_for(sun_zenith_rad);
  std::vector<double> angles;
  for (int k = -steps.below; k <= steps.above; ++k) {
    const double angle = sun_zenith_rad + k * steps.step_rad;
    if (k == 0) own = angles.size();
    if (k != 0 && !(angle >= 0.0 && angle < kLowestSun_rad + 3.0 * math::kDegree)) continue;
    angles.push_back(angle);
    if (!finely || k < -kFar || k >= kFar || angle + steps.step_rad < kFirst_rad || angle > kLast_rad)
      continue;
    for (int part = 1; part < kParts; ++part) angles.push_back(angle + steps.step_rad * part / kParts);
  }
  while (angles.size() < 3) angles.push_back(angles.back() + steps.step_rad);
  return angles;
}

/// Suns over whose columns light is spread in its own way, for places that are brighter than that of a Sun at dusk.
std::vector<double> brighter_than(double sun_zenith_rad) {
  constexpr double kSuns_deg[] = {89.0, 89.5, 89.75, 90.0, 90.25, 90.5}, kApart_rad = 0.05 * math::kDegree;
  std::vector<double> suns;
  for (const double sun_deg : kSuns_deg)
    if (sun_deg * math::kDegree < sun_zenith_rad - kApart_rad) suns.push_back(sun_deg * math::kDegree);
  return suns;
}
/// While the Sun is at dusk: so far light changes by much within what a line of sight sees.
bool is_dusk(double sun_zenith_rad) {
  constexpr double kFirst_rad = 88.0 * math::kDegree, kLast_rad = 92.0 * math::kDegree;
  return sun_zenith_rad > kFirst_rad && sun_zenith_rad < kLast_rad;
}

/// Up to the first the Sun counts as equally high all along each ray, from the second on it turns.
constexpr double kStill_rad = 74.0 * math::kDegree, kTurns_rad = 80.0 * math::kDegree;

/// Depth of what aerosol scatters without its peak, times 1 - g.
double turned_by_aerosol(const ScatteringColumn& column) {
  double depth = 0.0;
  for (std::size_t i = 0; i < column.layer_depth.size(); ++i) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[i];
    depth += column.layer_depth[i] * mixture.aerosol * (1.0 - mixture.peak) * (1.0 - mixture.first);
  }
  return depth;
}

/// Clouds and fog are thinned to a depth that orders of scattering get through: within a thick one light goes its way over
/// less than what an Earth is round over, and what comes out goes with what came in.
constexpr double kMostDepth = 0.5;
double thin(ScatteringColumn& column) {
  const double depth = turned_by_aerosol(column);
  if (depth <= kMostDepth) return 1.0;
  const double share = kMostDepth / depth;
  for (std::size_t i = 0; i < column.layer_depth.size(); ++i) {
    ScatteringColumn::Mixture& mixture = column.mixtures[i];
    const double kept = 1.0 - (1.0 - share) * mixture.aerosol * (1.0 - mixture.peak);
    column.layer_depth[i] *= kept;
    mixture.rayleigh /= kept, mixture.aerosol *= share / kept;
  }
  return share;
}

/// What molecules scatter over what aerosol does without its peak and what goes on forwards. Light that haze sends on
/// from molecules' light keeps a direction; that which haze has from haze is bundled about the horizon, and two terms of a pattern
/// would send what it lacks there backwards, as too much.
constexpr double kMostMolecules = 10.0;
double by_molecules(const ScatteringColumn& column) {
  double molecules = 0.0;
  for (std::size_t i = 0; i < column.layer_depth.size(); ++i)
    molecules += column.layer_depth[i] * column.mixtures[i].rayleigh;
  const double aerosol = turned_by_aerosol(column);
  return molecules < kMostMolecules * aerosol ? molecules / aerosol : kMostMolecules;
}

/// Below this share light at dusk is what grazes haze and clouds.
constexpr double kDarkMolecules = 0.3;

/// At the lower edge of haze or a cloud aloft comes light from beyond its horizon, where the round Earth turns it to where one looks
/// below the horizontal: it gets no farther than this into the layer.
constexpr double kAboveEdge[] = {0.16, 0.06, 0.02};
bool is_lower_edge(const ScatteringColumn& column, std::size_t layer) {
  constexpr double kEdge = 0.25;
  const auto density = [&](std::size_t i) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[i];
    return column.layer_depth[i] * mixture.aerosol * (1.0 - mixture.peak) /
           (column.layer_altitude_km[i] - column.layer_altitude_km[i + 1]);
  };
  return layer + 1 < column.layer_depth.size() && density(layer + 1) < kEdge * density(layer);
}

/// Layers of haze and cloud that a low Sun does not get through are cut: sunlight that is scattered once is straight between
/// boundaries, and all of it is scattered where the beam comes in.
void cut(ScatteringColumn& column, double lowest_sun_rad, bool finely) {
  constexpr double kBeamDepth = 0.5, kDark = 12.0, kLeastScattered = 0.01;
  constexpr double kLevel_rad = 89.0 * math::kDegree;  // somewhere the Sun is level
  constexpr int kMostParts = 16;
  constexpr double kFinePart = 0.15;  // as far as altitudes at dusk are apart
  const ScatteringColumn whole = column;
  column.layer_altitude_km = {whole.layer_altitude_km.front()};
  column.layer_depth.clear(), column.mixtures.clear();
  std::size_t sublayer = 0;
  for (std::size_t i = 0; i < whole.layer_depth.size(); ++i) {
    const std::size_t top = sublayer;
    while (sublayer < whole.sublayers() && whole.mixture_of[sublayer] == i) ++sublayer;
    const ScatteringColumn::Mixture& mixture = whole.mixtures[i];
    const bool scatters = whole.layer_depth[i] * mixture.aerosol * (1.0 - mixture.peak) > kLeastScattered;
    const double near = std::min(kDark, whole.beam_depth[top]),
                 far = std::min(kDark, whole.beam_depth[sublayer]);
    const double high_km = whole.layer_altitude_km[i], low_km = whole.layer_altitude_km[i + 1];
    const double level = lowest_sun_rad > kLevel_rad
                             ? std::min(kDark, level_beam_depth(high_km, low_km, whole.layer_depth[i]))
                             : 0.0;
    const int parts =
        scatters ? static_cast<int>(std::clamp(std::floor(std::max(level, std::abs(far - near)) / kBeamDepth),
                                               1.0, static_cast<double>(kMostParts)))
                 : 1;
    const double bend = bend_of_cuts(high_km, low_km, whole.layer_depth[i], lowest_sun_rad);
    const auto add = [&](double from, double to) {
      column.layer_altitude_km.push_back(to < 1.0 ? high_km + (low_km - high_km) * to : low_km);
      column.layer_depth.push_back(whole.layer_depth[i] * (to - from));
      column.mixtures.push_back(mixture);
    };
    std::vector<double> ends;  // shares of the layer
    for (int part = 1; part <= parts; ++part) {
      const double from = place_of_cut(part - 1, parts, bend), to = place_of_cut(part, parts, bend);
      const int again =
          finely && parts > 1
              ? std::max(1, static_cast<int>(std::ceil(whole.layer_depth[i] * (to - from) / kFinePart)))
              : 1;
      for (int k = 1; k < again; ++k) ends.push_back(from + (to - from) * k / again);
      ends.push_back(to);
    }
    if (scatters && !finely && is_lower_edge(whole, i))
      for (const double above : kAboveEdge)
        if (2.0 * above < whole.layer_depth[i]) ends.push_back(1.0 - above / whole.layer_depth[i]);
    std::sort(ends.begin(), ends.end());
    double from = 0.0;
    for (const double to : ends) {
      add(from, to);
      from = to;
    }
  }
}

/// Linear between altitudes that rise.
double between(const std::vector<double>& altitude_km, double z, std::size_t stride, const double* values) {
  const auto above = std::upper_bound(altitude_km.begin() + 1, altitude_km.end() - 1, z);
  const std::size_t low = static_cast<std::size_t>(above - altitude_km.begin()) - 1;
  const double share =
      std::clamp((z - altitude_km[low]) / (altitude_km[low + 1] - altitude_km[low]), 0.0, 1.0);
  return (1.0 - share) * values[low * stride] + share * values[(low + 1) * stride];
}

}  // namespace

RoundEarthLight::RoundEarthLight(const ScatteringColumn& whole) {
  std::size_t own = 0;
  const double sun_rad = std::acos(whole.sun_mu);
  const double molecules = by_molecules(whole);
  const bool by_particles = molecules < 1.0, dusk = molecules < kMostMolecules && is_dusk(sun_rad);
  angle_rad_ = angles_about(sun_rad, by_particles, own);
  own_rad_ = sun_rad;
  const bool finely = dusk && molecules < kDarkMolecules;
  if (dusk) brighter_rad_ = brighter_than(sun_rad);
  ScatteringColumn column = whole;
  cut(column, sun_rad < kTurns_rad ? sun_rad : angle_rad_.back(), finely);
  double directed = std::min(1.0, molecules);  // before it is thinned
  directed *= thin(column);
  const std::size_t angles = angle_rad_.size();
  std::vector<double> flat_rad = brighter_rad_;
  flat_rad.push_back(sun_rad);
  const std::size_t suns = flat_rad.size(), last = suns - 1;
  ShellOrders::Fineness fineness;
  fineness.dusk = finely;
  const ShellOrders flat(column, {false, false}, flat_rad, last, fineness);
  // While the Sun is high it is as good as equally high all along a ray, and that costs a tenth.
  const double low = std::clamp((sun_rad - kStill_rad) / (kTurns_rad - kStill_rad), 0.0, 1.0);
  constexpr double kLongest_km = 60.0;
  std::vector<double> log_mean, log_flux, up, sunward;
  const auto add = [&](const ShellOrders& shells, double share) {
    log_mean.resize(shells.log_mean().size(), 0.0);
    log_flux.resize(shells.log_flux().size(), 0.0);
    up.resize(shells.up().size(), 0.0);
    sunward.resize(shells.sunward().size(), 0.0);
    for (std::size_t k = 0; k < log_mean.size(); ++k) {
      log_mean[k] += share * shells.log_mean()[k];
      up[k] += share * shells.up()[k];
      sunward[k] += share * shells.sunward()[k];
    }
    for (std::size_t k = 0; k < log_flux.size(); ++k) log_flux[k] += share * shells.log_flux()[k];
  };
  if (low < 1.0) add({column, {true, false}, angle_rad_, own, fineness}, 1.0 - low);
  fineness.longest_km = kLongest_km;
  if (low > 0.0) add({column, {true, true}, angle_rad_, own, fineness}, low);
  own_over_.resize(brighter_rad_.size());
  std::vector<double> flux, flat_flux;
  for (std::size_t k = 0; k < log_flux.size(); ++k) {
    flux.push_back(std::exp(log_flux[k]));
    flat_flux.push_back(std::exp(flat.log_flux()[k]));
  }
  for (const double z : column.altitude_km) {
    const auto of_flat = [&](const std::vector<double>& values) {
      return between(flat.altitude_km(), z, suns, values.data() + last);
    };
    log_flat_.push_back(of_flat(flat.log_mean()));
    for (std::size_t k = 0; k < last; ++k)
      own_over_[k].push_back(
          std::exp(log_flat_.back() - between(flat.altitude_km(), z, suns, flat.log_mean().data() + k)));
    const double flat_up = of_flat(flat.up()), flat_sunward = of_flat(flat.sunward());
    for (std::size_t k = 0; k < angles; ++k) {
      const auto of_shells = [&](const std::vector<double>& values) {
        return between(flat.altitude_km(), z, angles, values.data() + k);
      };
      log_ratio_.push_back(of_shells(log_mean) - log_flat_.back());
      up_.push_back(directed * (of_shells(up) - flat_up));
      sunward_.push_back(directed * (of_shells(sunward) - flat_sunward));
    }
    // Fluxes between altitudes, not their ratio: that of the little light above haze or cloud says nothing of what is within.
    flux_ratio_.push_back(between(flat.altitude_km(), z, 1, flux.data()) /
                          between(flat.altitude_km(), z, 1, flat_flux.data()));
  }
}

RoundEarthLight::Change RoundEarthLight::change(std::size_t sublayer, double position, double sun_mu) const {
  const double angle = std::clamp(std::acos(sun_mu), angle_rad_.front(), angle_rad_.back());
  // A parabola through the three nearest.
  const std::size_t above = static_cast<std::size_t>(
      std::upper_bound(angle_rad_.begin() + 1, angle_rad_.end() - 1, angle) - angle_rad_.begin());
  const bool nearer_below = angle - angle_rad_[above - 1] < angle_rad_[above] - angle;
  const std::size_t middle =
      std::clamp<std::size_t>(nearer_below ? above - 1 : above, 1, angle_rad_.size() - 2);
  const double from_low = angle - angle_rad_[middle - 1], from_middle = angle - angle_rad_[middle],
               from_high = angle - angle_rad_[middle + 1];
  const double below_step = angle_rad_[middle] - angle_rad_[middle - 1],
               above_step = angle_rad_[middle + 1] - angle_rad_[middle];
  const double before = from_middle * from_high / (below_step * (below_step + above_step)),
               here = -from_low * from_high / (below_step * above_step),
               after = from_low * from_middle / (above_step * (below_step + above_step));
  const auto at = [&](const std::vector<double>& values) {
    const double* top = values.data() + sublayer * angle_rad_.size() + middle;
    const double* bottom = top + angle_rad_.size();
    return (1.0 - position) * (before * top[-1] + here * top[0] + after * top[1]) +
           position * (before * bottom[-1] + here * bottom[0] + after * bottom[1]);
  };
  Change change;
  change.ratio = std::exp(at(log_ratio_));
  const double mean =
      change.ratio * std::exp((1.0 - position) * log_flat_[sublayer] + position * log_flat_[sublayer + 1]);
  change.up = mean * at(up_);
  change.sunward = mean * at(sunward_);
  return change;
}

RoundEarthLight::Between RoundEarthLight::between_suns(std::size_t sublayer, double position, double sun_mu,
                                                       const Change& there) const {
  Between between;
  const double angle = std::acos(sun_mu);
  if (brighter_rad_.empty() || angle >= own_rad_) return between;
  const auto sun = [&](std::size_t k) { return k < brighter_rad_.size() ? brighter_rad_[k] : own_rad_; };
  while (between.first + 1 < brighter_rad_.size() && angle >= sun(between.first + 1)) ++between.first;
  between.next =
      std::clamp((angle - sun(between.first)) / (sun(between.first + 1) - sun(between.first)), 0.0, 1.0);
  // What there is of the column's own light is spread as that.
  const double own = change(sublayer, position, std::cos(own_rad_)).ratio / there.ratio;
  between.weight = std::max(0.0, 1.0 - own * own);
  return between;
}

}  // namespace ifov::atmosphere
