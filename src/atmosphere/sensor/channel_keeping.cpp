// The part of ChannelScattering that keeps solutions and takes them from what was kept.
#include <memory>
#include <span>

#include "atmosphere/scattering/ground/ground_modes.h"
#include "atmosphere/scattering/phase/phase_function.h"
#include "atmosphere/sensor/channel_scattering.h"
#include "atmosphere/sensor/directions/sky_directions.h"

namespace ifov::atmosphere {

std::vector<double> solution_question(const ScatteringOptions& options, const SensorGeometry& geometry,
                                      const Levels& levels, const LayerOptics& optics) {
  constexpr double kRoundEarth = 6.0;  // of how columns are solved: other answers have another number
  std::vector<double> all{kRoundEarth,
                          geometry.any_sun_zenith_rad(),
                          geometry.view_zenith_rad,
                          geometry.view_azimuth_rad,
                          geometry.sensor_altitude_km,
                          options.aerosol_polarization,
                          options.sublayer_depth,
                          options.tolerance};
  for (const int count : {options.nodes_per_hemisphere, options.polarized ? 1 : 0,
                          options.spherical_earth ? 1 : 0, options.most_sublayers, options.most_orders})
    all.push_back(count);
  for (const std::vector<double>* list :
       {&levels.altitude_km, &optics.gas_absorption, &optics.rayleigh_scattering, &optics.aerosol_scattering,
        &optics.aerosol_absorption, &optics.aerosol_asymmetry}) {
    all.push_back(static_cast<double>(list->size()));
    all.insert(all.end(), list->begin(), list->end());
  }
  all.push_back(optics.depolarization);
  if (optics.aerosol_phases)
    for (const PhaseFunction& function : optics.aerosol_phases->functions) {
      all.push_back(function.peak_exponent());
      for (const std::vector<double>* list : {&function.angles().angle_rad, &function.logarithms()}) {
        all.push_back(static_cast<double>(list->size()));
        all.insert(all.end(), list->begin(), list->end());
      }
      if (const PolarizationRatios* ratios = function.polarization())
        for (const std::vector<double>* list : {&ratios->a2, &ratios->a3, &ratios->b1})
          all.insert(all.end(), list->begin(), list->end());
    }
  if (optics.aerosol_phases)
    all.insert(all.end(), optics.aerosol_phases->share.begin(), optics.aerosol_phases->share.end());
  return all;
}

std::vector<double> ChannelScattering::question(const ColumnSolver& solver, const Node& node) const {
  std::vector<double> all = solution_question(solver.options(), geometry_, column_.levels(), node.optics);
  for (const std::vector<double>* list :
       {&directions_.zenith_rad, &directions_.azimuth_rad, &geometry_.heights_km}) {
    all.push_back(static_cast<double>(list->size()));
    all.insert(all.end(), list->begin(), list->end());
  }
  for (const LineOfSight& line : geometry_.lines_of_sight)
    all.insert(all.end(), {line.zenith_rad, line.azimuth_rad, line.height_km, line.sensor_km});
  if (polarized_) all.push_back(1.0);
  if (geometry_.level_fluxes) all.push_back(2.0);
  if (const std::shared_ptr<const GroundModes> ground = ground_modes(solver, node.wavelength))
    for (const std::vector<double>* list : {&ground->numbers(), &ground->beam_numbers()}) {
      all.push_back(static_cast<double>(list->size()));
      all.insert(all.end(), list->begin(), list->end());
    }
  return all;
}

void ChannelScattering::solve(const ColumnSolver& solver, std::size_t solution, KeptSolutions* kept) {
  Node& node = nodes_[solution];
  if (kept == nullptr) return solve(solver, node);
  const std::vector<double> asked = question(solver, node);
  const std::size_t rings = directions_.zenith_rad.size() * (directions_.azimuth_rad.size() + 1);
  std::size_t count = 4 + 2 * geometry_.lines_of_sight.size() + geometry_.heights_km.size() + rings;
  if (polarized_)
    count += 3 * (1 + geometry_.lines_of_sight.size()) + 2 * rings - directions_.zenith_rad.size();
  if (geometry_.level_fluxes) count += 3;
  count += reflected_count();
  std::vector<double> answer(count);
  if (kept->find(asked, answer))
    return node.unpack(answer, geometry_, directions_, polarized_, reflected_count());
  solve(solver, node);
  kept->keep(asked, node.packed(geometry_.level_fluxes));
}

std::vector<double> ChannelScattering::Node::packed(bool level_fluxes) const {
  std::vector<double> answer{path, sky_irradiance, diffuse_transmittance, spherical_albedo};
  for (const std::vector<double>* list :
       {&line_of_sight_path, &line_of_sight_diffuse, &sky_at_height, &sky, &groundlit, &sky_polarization.q,
        &sky_polarization.u, &sky_polarization.groundlit_q})
    answer.insert(answer.end(), list->begin(), list->end());
  for (const LinePolarization& line : lines) answer.insert(answer.end(), {line.q, line.u, line.diffuse_q});
  if (level_fluxes) answer.insert(answer.end(), {level_up, ground_up, ground_down});
  answer.insert(answer.end(), reflected.begin(), reflected.end());
  return answer;
}

void ChannelScattering::Node::unpack(std::span<const double> answer, const SensorGeometry& geometry,
                                     const SkyDirections& directions, bool polarized,
                                     std::size_t reflected_count) {
  const std::span<const double> last = answer.last(reflected_count);
  reflected.assign(last.begin(), last.end());
  answer = answer.first(answer.size() - reflected_count);
  path = answer[0];
  sky_irradiance = answer[1];
  diffuse_transmittance = answer[2];
  spherical_albedo = answer[3];
  const std::size_t zeniths = directions.zenith_rad.size(), azimuths = directions.azimuth_rad.size();
  std::size_t next = 4;
  const auto take = [&](std::vector<double>& list, std::size_t count) {
    const auto part = answer.subspan(next, count);
    list.assign(part.begin(), part.end());
    next += count;
  };
  take(line_of_sight_path, geometry.lines_of_sight.size());
  take(line_of_sight_diffuse, geometry.lines_of_sight.size());
  take(sky_at_height, geometry.heights_km.size());
  take(sky, zeniths * azimuths);
  take(groundlit, zeniths);
  if (geometry.level_fluxes) {
    level_up = answer[answer.size() - 3];
    ground_up = answer[answer.size() - 2];
    ground_down = answer[answer.size() - 1];
    answer = answer.first(answer.size() - 3);
  }
  if (!polarized) return;
  take(sky_polarization.q, zeniths * azimuths);
  take(sky_polarization.u, zeniths * azimuths);
  take(sky_polarization.groundlit_q, zeniths);
  for (; next < answer.size(); next += 3) lines.push_back({answer[next], answer[next + 1], answer[next + 2]});
}

}  // namespace ifov::atmosphere
