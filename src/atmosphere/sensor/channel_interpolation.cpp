// The part of ChannelScattering that goes from solutions to points, and what goes through the level at the sensor's altitude.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "atmosphere/scattering/shell_line_of_sight.h"
#include "atmosphere/scattering/single_scattering.h"
#include "atmosphere/sensor/channel_scattering.h"

namespace ifov::atmosphere {
namespace {

/// What of sunlight paths scatter towards the sensor, and how gas dims it, where points are chosen to be
/// checked: rough is enough. A point on a solution counts a little, for there may be none between.
constexpr double kPathShare = 0.1, kPathDepth = 0.3, kLeastWeakness = 0.01;
constexpr std::size_t kMostChecks = 2;

struct Bracket {
  std::size_t low = 0;
  double high_share = 0.0;
};
Bracket bracket(const std::vector<double>& nodes, double x) {
  if (nodes.size() == 1) return {};
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const std::size_t low = static_cast<std::size_t>(above - nodes.begin()) - 1;
  return {low, (x - nodes[low]) / (nodes[low + 1] - nodes[low])};
}

}  // namespace

std::vector<ChannelScattering::WeakPoint> ChannelScattering::weak_points() const {
  struct Gap {
    double light = 0.0, weakness = 0.0, worst = -1.0;
    std::size_t point = 0;
  };
  std::map<std::pair<std::size_t, std::size_t>, Gap> gaps;
  const auto bulge = [](double share) { return share >= 1.0 ? 1.0 : std::abs(4.0 * share * (1.0 - share)); };
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const double gas = points_.gas_depth[p];
    const Bracket wavelength = bracket(log_wavelength_, std::log(points_.points[p].wavelength_um));
    const Bracket depth = bracket(scaled_depth_, scaled_depth(gas));
    const double light =
        points_.share[p] * (points_.sun_base()[p] * points_.view_base()[p] +
                            kPathShare * points_.irradiance[p] * std::exp(-kPathDepth * gas));
    const double weakness =
        light * std::max({kLeastWeakness, bulge(wavelength.high_share), bulge(depth.high_share)});
    Gap& gap = gaps[{wavelength.low, depth.low}];
    gap.light += light;
    gap.weakness += weakness;
    if (weakness > gap.worst) {
      gap.worst = weakness;
      gap.point = p;
    }
  }
  std::vector<Gap> chosen;
  for (const auto& entry : gaps) chosen.push_back(entry.second);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Gap& a, const Gap& b) { return a.weakness > b.weakness; });
  if (chosen.size() > kMostChecks) chosen.resize(kMostChecks);
  double all = 0.0;
  for (const Gap& gap : chosen) all += gap.light;
  std::vector<WeakPoint> points;
  for (const Gap& gap : chosen)
    points.push_back({gap.point, all > 0.0 ? gap.light / all : 1.0 / static_cast<double>(chosen.size())});
  return points;
}

std::vector<ChannelScattering::Part> ChannelScattering::parts_at(std::size_t p) const {
  const std::size_t columns = depth_.size();
  const Bracket at_wavelength = bracket(log_wavelength_, std::log(points_.points[p].wavelength_um));
  const double depth = std::clamp(points_.gas_depth[p], depth_.front(), depth_.back());
  const Bracket at_depth = bracket(depth_, depth), at_scaled = bracket(scaled_depth_, scaled_depth(depth)),
                at_emitted = bracket(emitted_depth_, emitted_depth(depth));
  std::vector<Part> parts;
  for (std::size_t w = at_wavelength.low; w <= std::min(at_wavelength.low + 1, log_wavelength_.size() - 1);
       ++w)
    for (std::size_t d = 0; d < columns; ++d) {
      const double across =
          w == at_wavelength.low ? 1.0 - at_wavelength.high_share : at_wavelength.high_share;
      const auto share = [&](const Bracket& here) {
        return d == here.low ? 1.0 - here.high_share : d == here.low + 1 ? here.high_share : 0.0;
      };
      const std::size_t solution = w * columns + d;
      parts.push_back({&nodes_[solution], solution, across * share(at_depth), across * share(at_scaled),
                       across * share(at_emitted)});
    }
  return parts;
}

double ChannelScattering::between(double low_km, double high_km, std::span<const double> depth) const {
  const std::vector<double>& at_km = column_.levels().altitude_km;
  double sum = 0.0;
  for (std::size_t i = 0; i < depth.size() && at_km[i] < high_km; ++i) {
    const double within = std::min(high_km, at_km[i + 1]) - std::max(low_km, at_km[i]);
    sum += depth[i] * std::max(0.0, within) / (at_km[i + 1] - at_km[i]);
  }
  return sum;
}

/// Gas above a sensor, ozone in the stratosphere, dims nothing that the ground sends there. A point that has much of it is as a
/// solution of little gas, if there is little below.
std::vector<ChannelScattering::Part> ChannelScattering::parts_by_gas(
    std::vector<Part> parts, double here, std::span<const double> of_solutions) const {
  const std::size_t columns = depth_.size();
  if (columns < 2) return parts;
  for (std::size_t first = 0; first < parts.size(); first += columns) {
    double across = 0.0;
    for (std::size_t d = 0; d < columns; ++d) across += parts[first + d].plain;
    const std::span<const double> gas = of_solutions.subspan(parts[first].solution, columns);
    std::size_t low = 0;
    while (low + 2 < columns && here >= gas[low + 1]) ++low;
    const double step = gas[low + 1] - gas[low],
                 share = step > 0.0 ? std::clamp((here - gas[low]) / step, 0.0, 1.0) : 0.0;
    for (std::size_t d = 0; d < columns; ++d)
      parts[first + d].plain = across * (d == low ? 1.0 - share : d == low + 1 ? share : 0.0);
  }
  return parts;
}

ChannelScattering::AtPoints ChannelScattering::at_points() const {
  const std::size_t count = points_.size(), lines_of_sight = geometry_.lines_of_sight.size(),
                    heights = geometry_.heights_km.size();
  AtPoints result;
  for (auto* row : {&result.once, &result.path, &result.sky_irradiance, &result.diffuse_transmittance,
                    &result.spherical_albedo})
    row->resize(count);
  result.line_of_sight_path.assign(lines_of_sight, std::vector<double>(count));
  result.line_of_sight_diffuse.assign(lines_of_sight, std::vector<double>(count));
  result.sky_at_height.assign(heights, std::vector<double>(count));
  if (polarized_)
    for (auto* rows : {&result.path_q, &result.path_u, &result.diffuse_q})
      rows->assign(1 + lines_of_sight, std::vector<double>(count));
  if (ground_ != nullptr)
    for (auto* rows : {&result.reflected_i, &result.reflected_q, &result.reflected_u})
      rows->assign(1 + lines_of_sight, std::vector<double>(count));
  result.share.assign(nodes_.size(), std::vector<double>(count, 0.0));
  result.emission_share = result.share;
  const std::vector<double>& levels_km = column_.levels().altitude_km;
  const std::vector<double> falling_km(levels_km.rbegin(), levels_km.rend());
  const std::vector<LineOfSight> seen = lines();
  std::vector<ShellLineOfSight> sights, to_space;
  // By sight and solution, the gas between the ground and the sensor; empty where that is above all.
  std::vector<std::vector<double>> gas_below(seen.size());
  const auto gas_along = [&](const LineOfSight& line, const LayerOptics& layers) {
    return between(levels_km.front() + line.height_km, line.sensor_km, layers.gas_absorption);
  };
  for (std::size_t s = 0; s < seen.size(); ++s) {
    const LineOfSight& line = seen[s];
    for (const Node& node : nodes_)
      if (line.sensor_km < levels_km.back()) gas_below[s].push_back(gas_along(line, node.optics));
    const auto add = [&](std::vector<ShellLineOfSight>& all, double sensor_km) {
      all.emplace_back(falling_km, options_.spherical_earth, std::cos(geometry_.any_sun_zenith_rad()),
                       Propagation{std::cos(line.zenith_rad), line.azimuth_rad - std::numbers::pi},
                       ShellLineOfSight::Ends{levels_km.front() + line.height_km, sensor_km});
    };
    add(sights, line.sensor_km);
    if (low_sun()) add(to_space, levels_km.back());
  }
  for (std::size_t p = 0; p < count; ++p) {
    const ChannelPoints::Point& point = points_.points[p];
    const LayerOptics layers = point.layers();
    const ScatteringColumn column =
        ScatteringColumn::of_layers(column_.levels(), layers, geometry_.any_sun_zenith_rad(), options_);
    const auto once = [&](const ShellLineOfSight& line) {
      if (!sunlit_) return StokesVector{};
      return points_.irradiance[p] * single_scattering(column, options_.aerosol_polarization, line).single;
    };
    const auto base_of = [&](std::size_t sight, const StokesVector& single) {
      return path_base(single.i, to_space.empty() ? 0.0 : once(to_space[sight]).i);
    };
    const std::vector<Part> parts = parts_at(p);
    for (const Part& part : parts) {
      result.share[part.solution][p] = part.plain;
      result.emission_share[part.solution][p] = part.emitted;
    }
    const auto mean = [](const std::vector<Part>& over, const auto& of) {
      double sum = 0.0;
      for (const Part& part : over) sum += part.plain * of(*part.node);
      return std::exp(sum);
    };
    const auto ratio = [&](const auto& of) { return mean(parts, of); };
    const auto parts_below = [&](std::size_t sight) {
      return gas_below[sight].empty() ? parts
                                      : parts_by_gas(parts, gas_along(seen[sight], layers), gas_below[sight]);
    };
    const auto path_ratio = [&](const auto& of) {
      double sum = 0.0;
      for (const Part& part : parts) sum += part.scaled * of(*part.node);
      return std::exp(sum);
    };
    const StokesVector own = once(sights.front());
    result.once[p] = own.i;
    const double sun_base = sunlit_ ? points_.sun_base()[p] : 0.0;
    const double own_base = !points_.is_under_cloud(geometry_.sensor_altitude_km) ? base_of(0, own)
                            : sunlit_ ? points_.sun_at_sensor_base()[p]
                                      : 0.0;
    result.path[p] = own_base * path_ratio([](const Node& n) { return n.path; });
    const std::vector<Part> own_parts = parts_below(0);
    result.sky_irradiance[p] = sun_base * ratio([](const Node& n) { return n.sky_irradiance; });
    result.diffuse_transmittance[p] =
        points_.view_base()[p] * mean(own_parts, [](const Node& n) { return n.diffuse_transmittance; });
    result.spherical_albedo[p] = ratio([](const Node& n) { return n.spherical_albedo; });
    if (geometry_.level_fluxes) add_fluxes(p, parts, own_parts, own_base, result);
    if (polarized_) polarize(0, p, parts, own, result.path[p], result.diffuse_transmittance[p], result);
    for (std::size_t s = 0; s < lines_of_sight; ++s) {
      const StokesVector along = once(sights[1 + s]);
      result.line_of_sight_path[s][p] =
          (!points_.is_under_cloud(geometry_.lines_of_sight[s].sensor_km) ? base_of(1 + s, along)
           : sunlit_                                                      ? points_.sun_at_line_end_base(s)[p]
                                                                          : 0.0) *
          path_ratio([s](const Node& n) { return n.line_of_sight_path[s]; });
      result.line_of_sight_diffuse[s][p] =
          points_.line_of_sight_base(s)[p] *
          mean(parts_below(1 + s), [s](const Node& n) { return n.line_of_sight_diffuse[s]; });
      if (polarized_)
        polarize(1 + s, p, parts, along, result.line_of_sight_path[s][p], result.line_of_sight_diffuse[s][p],
                 result);
    }
    if (ground_ != nullptr) add_reflected(p, parts, result);
    for (std::size_t h = 0; h < heights; ++h)
      result.sky_at_height[h][p] = sunlit_ ? points_.sun_at_height_base(h)[p] *
                                                 ratio([h](const Node& n) { return n.sky_at_height[h]; })
                                           : 0.0;
  }
  return result;
}

double ChannelScattering::depth_to_sensor(const LayerOptics& layers) const {
  double depth = 0.0;
  for (const std::vector<double>* part : {&layers.gas_absorption, &layers.rayleigh_scattering,
                                          &layers.aerosol_scattering, &layers.aerosol_absorption})
    depth += between(column_.levels().altitude_km.front(), geometry_.sensor_altitude_km, *part);
  return depth;
}

void ChannelScattering::solve_fluxes(const ColumnSolution& solved, double base, Node& node) const {
  const ColumnSolution::GroundFlux ground = solved.ground_flux(geometry_.sensor_altitude_km);
  node.level_up = log_ratio(solved.sunlit().fluxes().at(geometry_.sensor_altitude_km).up, base);
  node.ground_up = log_ratio(ground.up, straight_flux(depth_to_sensor(node.optics)));
  node.ground_down = log_ratio(ground.down, 1.0);
}

void ChannelScattering::add_fluxes(std::size_t point, const std::vector<Part>& parts,
                                   const std::vector<Part>& below, double base, AtPoints& at) const {
  double level_up = 0.0, ground_up = 0.0, ground_down = 0.0;
  for (const Part& part : parts) {
    level_up += part.scaled * part.node->level_up;
    ground_down += part.plain * part.node->ground_down;
  }
  for (const Part& part : below) ground_up += part.plain * part.node->ground_up;
  at.level_up.push_back(sunlit_ ? base * std::exp(level_up) : 0.0);
  at.ground_up.push_back(straight_flux(depth_to_sensor(points_.points[point].layers())) *
                         std::exp(ground_up));
  at.ground_down.push_back(std::exp(ground_down));
}

}  // namespace ifov::atmosphere
