// The part of ChannelScattering that tells Q and U.
#include <cmath>
#include <map>
#include <numbers>

#include "atmosphere/scattering/sky_ring.h"
#include "atmosphere/sensor/channel_scattering.h"
#include "atmosphere/sensor/directions/sky_directions.h"

namespace ifov::atmosphere {

std::vector<LineOfSight> ChannelScattering::lines() const {
  std::vector<LineOfSight> all{geometry_.own_sight()};
  all.insert(all.end(), geometry_.lines_of_sight.begin(), geometry_.lines_of_sight.end());
  return all;
}

void ChannelScattering::solve_polarization(const ColumnSolution& solved, double scale, double groundlit_scale,
                                           Node& node) const {
  const double ground_km = column_.levels().altitude_km.front();
  std::map<double, SlantSource> rings;  // by cosine, as in solve_lines_of_sight
  for (const LineOfSight& line : lines()) {
    const double mu = std::cos(line.zenith_rad), surface_km = ground_km + line.height_km;
    const SlantSource& ring = rings.try_emplace(mu, solved.sunlit(), mu).first->second;
    const StokesVector often =
                           ring.line_of_sight(line.azimuth_rad - std::numbers::pi, line.sensor_km, surface_km)
                               .multiple,
                       diffuse = solved.diffuse_transmittance(mu, line.sensor_km, surface_km);
    LinePolarization& found = node.lines.emplace_back();
    if (often.i > 0.0) found.q = often.q / often.i, found.u = often.u / often.i;
    if (diffuse.i > 0.0) found.diffuse_q = diffuse.q / diffuse.i;
  }
  for (const double zenith : directions_.zenith_rad) {
    const double down = -std::cos(zenith);
    constexpr double kAnyAzimuth[] = {0.0};
    node.sky_polarization.groundlit_q.push_back(
        groundlit_scale * sky_ring_stokes(solved.groundlit(), down, kAnyAzimuth, ground_km)[0].q);
    std::vector<StokesVector> ring(directions_.azimuth_rad.size());
    if (sunlit_)
      ring = sky_ring_stokes(solved.sunlit(), down, directions_.azimuth_rad, ground_km,
                             directions_.sun_cell(*geometry_.sun_zenith_rad));
    for (const StokesVector& light : ring) {
      node.sky_polarization.q.push_back(scale * light.q);
      node.sky_polarization.u.push_back(scale * light.u);
    }
  }
}

/// Light scattered once is exact at every point; Q and U of the rest are interpolated relative to its I.
void ChannelScattering::polarize(std::size_t line, std::size_t point, const std::vector<Part>& parts,
                                 const StokesVector& once, double path, double diffuse, AtPoints& at) const {
  LinePolarization mean;
  for (const Part& part : parts) {
    const LinePolarization& there = part.node->lines[line];
    mean.q += part.scaled * there.q;
    mean.u += part.scaled * there.u;
    mean.diffuse_q += part.plain * there.diffuse_q;
  }
  at.path_q[line][point] = once.q + (path - once.i) * mean.q;
  at.path_u[line][point] = once.u + (path - once.i) * mean.u;
  at.diffuse_q[line][point] = mean.diffuse_q * diffuse;
}

}  // namespace ifov::atmosphere
