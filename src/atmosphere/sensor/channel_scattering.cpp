#include "atmosphere/sensor/channel_scattering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "atmosphere/column/light_limits.h"
#include "atmosphere/scattering/sky_ring.h"
#include "atmosphere/sensor/directions/sky_directions.h"
#include "math/angle.h"

namespace ifov::atmosphere {
namespace {

constexpr std::array kDepths = {0.0, 0.06, 0.25, 0.8, 2.2, 6.0, 25.0};
/// Channels wider than this in ln(wavelength) take a second wavelength, and one more for each further step: between the
/// wavelengths of the table of phase functions haze changes linearly, and by kinks at them.
constexpr double kNarrow = 0.03, kStep = 0.03;
constexpr std::size_t kMostWavelengths = 6;
/// Points that hold less of the channel do not decide how deep the solutions reach.
constexpr double kLeastShare = 1e-5;
constexpr double kDark = 1e-300;

}  // namespace

double ChannelScattering::log_ratio(double a, double b) {
  return std::log(std::max(a, kDark) / std::max(b, kDark));
}

bool ChannelScattering::low_sun() const {
  return sunlit_ && geometry_.any_sun_zenith_rad() > 75.0 * math::kDegree;
}

/// Scattered light is added to what is scattered once: it may come out below 0 by a little where it is next to nothing.
double ChannelScattering::over_base(const PathLight& path, double once_to_space) const {
  constexpr double kLeast = 0.5;
  const double base = path_base(path.single.i, once_to_space);
  return base > 0.0 ? log_ratio(std::max(kLeast * path.single.i, path.radiance().i), base) : 0.0;
}

double ChannelScattering::scaled_depth(double gas_depth) { return std::log1p(10.0 * gas_depth); }

double ChannelScattering::emitted_depth(double gas_depth) {
  constexpr double kDiffuse = 1.66, kBeyond = 0.05;  // Elsasser's diffusivity; slow change beyond depths of 1
  return -std::expm1(-kDiffuse * gas_depth) + kBeyond * scaled_depth(gas_depth);
}

ChannelScattering::ChannelScattering(const AtmosphereColumn& column, const ChannelPoints& points,
                                     const SensorGeometry& geometry, const SkyDirections& directions,
                                     const ScatteringOptions& options, bool polarized,
                                     const DirectionalGround* ground)
    : column_(column),
      points_(points),
      geometry_(geometry),
      directions_(directions),
      options_(options),
      sunlit_(geometry.sun_zenith_rad && points.points.front().wavelength_um <= kLastSolar_um),
      polarized_(polarized),
      ground_(ground) {
  options_.most_sublayers = 1;  // light scattered once is exact in whole layers
  choose_nodes();
  make_room_for_modes();
  for (std::size_t w = 0; w < log_wavelength_.size(); ++w)
    for (std::size_t d = 0; d < depth_.size(); ++d) {
      Node& node = nodes_.emplace_back();
      node.wavelength = w;
      node.depth = d;
      node.optics = optics_at(log_wavelength_[w], depth_[d]);
    }
}

double ChannelScattering::wavelength_um(std::size_t solution) const {
  return std::exp(log_wavelength_[nodes_[solution].wavelength]);
}

void ChannelScattering::choose_nodes() {
  std::vector<std::size_t> order(points_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points_.points[a].wavelength_um < points_.points[b].wavelength_um;
  });
  double sum = 0.0, mean = 0.0, low = 0.0, high = 0.0, shallow = kDepths.back(), deep = 0.0;
  for (const std::size_t p : order) {
    const double log_wavelength = std::log(points_.points[p].wavelength_um);
    if (sum < 0.05) low = log_wavelength;
    if (sum < 0.95) high = log_wavelength;
    sum += points_.share[p];
    mean += points_.share[p] * log_wavelength;
    if (points_.share[p] < kLeastShare) continue;
    shallow = std::min(shallow, points_.gas_depth[p]);
    deep = std::max(deep, points_.gas_depth[p]);
  }
  const double width = high - low;
  const std::size_t count =
      width < kNarrow ? 1
                      : std::min(kMostWavelengths, 2 + static_cast<std::size_t>((width - kNarrow) / kStep));
  for (std::size_t k = 0; k < count; ++k)
    log_wavelength_.push_back(
        count == 1 ? mean : low + width * static_cast<double>(k) / static_cast<double>(count - 1));
  for (std::size_t k = 0; k < kDepths.size(); ++k) {
    const bool too_shallow = k + 1 < kDepths.size() && kDepths[k + 1] <= shallow;
    const bool too_deep = k > 0 && kDepths[k - 1] >= deep;
    if (!too_shallow && !too_deep) depth_.push_back(kDepths[k]);
  }
  for (const double depth : depth_) {
    scaled_depth_.push_back(scaled_depth(depth));
    emitted_depth_.push_back(emitted_depth(depth));
  }
}

/// Everything but gas from the bin next to the wavelength; gas of the mean profile of the channel's points of
/// about this depth.
LayerOptics ChannelScattering::optics_at(double log_wavelength, double depth) const {
  const ChannelPoints::Point* nearest = &points_.points.front();
  const auto distance = [&](const ChannelPoints::Point& point) {
    return std::abs(std::log(point.wavelength_um) - log_wavelength);
  };
  std::vector<double> profile(column_.levels().layers(), 0.0);
  double total = 0.0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const ChannelPoints::Point& point = points_.points[p];
    if (distance(point) < distance(*nearest)) nearest = &point;
    if (!(points_.gas_depth[p] > 0.0)) continue;
    const double weight =
        points_.share[p] *
        std::exp(-4.0 * std::abs(scaled_depth(points_.gas_depth[p]) - scaled_depth(depth))) /
        points_.gas_depth[p];
    const std::vector<double> gas = point.layers().gas_absorption;
    for (std::size_t i = 0; i < profile.size(); ++i) profile[i] += weight * gas[i];
    total += weight * points_.gas_depth[p];
  }
  LayerOptics optics = nearest->layers();
  for (std::size_t i = 0; i < profile.size(); ++i)
    optics.gas_absorption[i] = total > 0.0 ? depth * profile[i] / total : 0.0;
  return optics;
}

Propagation ChannelScattering::towards_sensor() const {
  return {std::cos(geometry_.view_zenith_rad), geometry_.view_azimuth_rad - std::numbers::pi};
}

double ChannelScattering::once_to_space(const SlantSource& ring, double view_azimuth_rad,
                                        double surface_km) const {
  return low_sun() ? ring.line_of_sight(view_azimuth_rad - std::numbers::pi,
                                        column_.levels().altitude_km.back(), surface_km)
                         .single.i
                   : 0.0;
}

/// Ratios as at the ground and along the sensor's own line of sight.
void ChannelScattering::solve_lines_of_sight(const ColumnSolution& solved,
                                             const std::optional<ChannelPoints::Beams>& base,
                                             Node& node) const {
  const double ground_km = column_.levels().altitude_km.front();
  for (std::size_t h = 0; h < geometry_.heights_km.size(); ++h) {
    const double height_km = ground_km + geometry_.heights_km[h];
    node.sky_at_height.push_back(
        log_ratio(solved.sunlit().fluxes().at(height_km).diffuse_down,
                  base ? base->sun_at_height[h][0] : solved.sun_transmittance(height_km)));
  }
  std::map<double, SlantSource> rings;  // by cosine: lines of one slope end at several heights
  for (std::size_t s = 0; s < geometry_.lines_of_sight.size(); ++s) {
    const LineOfSight& line = geometry_.lines_of_sight[s];
    const double mu = std::cos(line.zenith_rad), surface_km = ground_km + line.height_km;
    const SlantSource& ring = rings.try_emplace(mu, solved.sunlit(), mu).first->second;
    const PathLight path =
        ring.line_of_sight(line.azimuth_rad - std::numbers::pi, line.sensor_km, surface_km);
    if (points_.is_under_cloud(line.sensor_km))
      node.line_of_sight_path.push_back(log_ratio(path.radiance().i, base.value().sun_at_line_end[s][0]));
    else
      node.line_of_sight_path.push_back(over_base(path, once_to_space(ring, line.azimuth_rad, surface_km)));
    node.line_of_sight_diffuse.push_back(
        log_ratio(solved.diffuse_transmittance(mu, line.sensor_km, surface_km).i,
                  base ? base->line_of_sight_view[s][0] : path.transmittance));
  }
}

void ChannelScattering::solve(const ColumnSolver& solver, Node& node) const {
  const double ground_km = column_.levels().altitude_km.front(), sensor_km = geometry_.sensor_altitude_km;
  const std::shared_ptr<const GroundModes> ground = ground_modes(solver, node.wavelength);
  const ColumnSolution solved =
      solver.solve(column_.levels(), node.optics, geometry_.any_sun_zenith_rad(), ground.get());
  const PathLight path = solved.sunlit().line_of_sight(towards_sensor(), sensor_km, ground_km);
  const double sky_irradiance = solved.sunlit().fluxes().at(ground_km).diffuse_down;
  const double albedo = solved.spherical_albedo();
  std::optional<ChannelPoints::Beams> base;
  if (points_.has_base()) base = points_.base_of(node.optics);
  const double to_space =
      once_to_space({solved.sunlit(), towards_sensor().mu}, geometry_.view_azimuth_rad, ground_km);
  node.path = points_.is_under_cloud(sensor_km) ? log_ratio(path.radiance().i, base.value().sun_at_sensor[0])
                                                : over_base(path, to_space);
  node.sky_irradiance = log_ratio(sky_irradiance, base ? base->sun[0] : solved.sun_transmittance(ground_km));
  node.diffuse_transmittance = log_ratio(solved.diffuse_transmittance(towards_sensor().mu, sensor_km).i,
                                         base ? base->view[0] : path.transmittance);
  node.spherical_albedo = std::log(std::max(albedo, kDark));

  solve_lines_of_sight(solved, base, node);
  if (geometry_.level_fluxes)
    solve_fluxes(solved,
                 points_.is_under_cloud(sensor_km) ? base.value().sun_at_sensor[0]
                                                   : path_base(path.single.i, to_space),
                 node);

  const std::vector<double> weights = directions_.level_weights();
  const std::size_t zeniths = directions_.zenith_rad.size(), azimuths = directions_.azimuth_rad.size();
  double sky_sum = 0.0, groundlit_sum = 0.0;
  for (std::size_t z = 0; z < zeniths; ++z) {
    const double down = -std::cos(directions_.zenith_rad[z]);
    constexpr double kAnyAzimuth[] = {0.0};
    node.groundlit.push_back(std::max(0.0, sky_ring(solved.groundlit(), down, kAnyAzimuth, ground_km)[0]));
    if (!sunlit_) {
      node.sky.resize(node.sky.size() + azimuths, 0.0);
      for (std::size_t a = 0; a < azimuths; ++a)
        groundlit_sum += weights[z * azimuths + a] * node.groundlit.back();
      continue;
    }
    const std::vector<double> ring = sky_ring(solved.sunlit(), down, directions_.azimuth_rad, ground_km,
                                              directions_.sun_cell(*geometry_.sun_zenith_rad));
    for (std::size_t a = 0; a < azimuths; ++a) {
      node.sky.push_back(std::max(0.0, ring[a]));
      sky_sum += weights[z * azimuths + a] * node.sky.back();
      groundlit_sum += weights[z * azimuths + a] * node.groundlit.back();
    }
  }
  for (double& value : node.sky) value /= std::max(sky_sum, kDark);
  for (double& value : node.groundlit) value *= std::numbers::pi / std::max(groundlit_sum, kDark);
  if (polarized_)
    solve_polarization(solved, 1.0 / std::max(sky_sum, kDark),
                       std::numbers::pi / std::max(groundlit_sum, kDark), node);
  if (ground_ != nullptr) solve_reflected(solved, node);
}

}  // namespace ifov::atmosphere
