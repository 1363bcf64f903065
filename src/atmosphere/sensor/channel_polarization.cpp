// The part of ChannelScattering that tells Q and U.
#include <cmath>
#include <map>
#include <numbers>

#include "atmosphere/scattering/single_scattering.h"
#include "atmosphere/scattering/sky_ring.h"
#include "atmosphere/sensor/channel_scattering.h"

namespace ifov::atmosphere {

std::vector<SightLine> ChannelScattering::lines() const {
  std::vector<SightLine> all{{geometry_.view_zenith_rad, geometry_.view_azimuth_rad, 0.0}};
  all.insert(all.end(), geometry_.sights.begin(), geometry_.sights.end());
  return all;
}

void ChannelScattering::solve_polarization(const ColumnSolution& solved, double scale, double groundlit_scale,
                                           Node& node) const {
  const double ground_km = column_.levels().altitude_km.front(), sensor_km = geometry_.sensor_altitude_km;
  std::map<double, SlantSource> rings;  // by cosine, as in solve_sights
  for (const SightLine& line : lines()) {
    const double mu = std::cos(line.zenith_rad),
                 length = sight_length_km(geometry_, ground_km, line.height_km, mu);
    const SlantSource& ring = rings.try_emplace(mu, solved.sunlit(), mu).first->second;
    const StokesVector often = ring.path(line.azimuth_rad - std::numbers::pi, sensor_km, length).multiple,
                       diffuse = solved.diffuse_transmittance(mu, sensor_km, length);
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
    if (sunlit_) ring = sky_ring_stokes(solved.sunlit(), down, directions_.azimuth_rad, ground_km);
    for (const StokesVector& light : ring) {
      node.sky_polarization.q.push_back(scale * light.q);
      node.sky_polarization.u.push_back(scale * light.u);
    }
  }
}

/// Light scattered once is exact at every point; Q and U of the rest are interpolated relative to its I.
void ChannelScattering::polarize(AtPoints& at) const {
  const std::vector<SightLine> all = lines();
  for (auto* rows : {&at.path_q, &at.path_u, &at.diffuse_q})
    rows->assign(all.size(), std::vector<double>(points_.size(), 0.0));
  const double ground_km = column_.levels().altitude_km.front();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const ScatteringColumn column(column_.levels(), points_.points[p].layers(),
                                  geometry_.any_sun_zenith_rad(), options_);
    const std::vector<Part> parts = parts_at(p);
    for (std::size_t s = 0; s < all.size(); ++s) {
      LinePolarization mean;
      for (const Part& part : parts) {
        mean.q += part.scaled * part.node->lines[s].q;
        mean.u += part.scaled * part.node->lines[s].u;
        mean.diffuse_q += part.plain * part.node->lines[s].diffuse_q;
      }
      at.diffuse_q[s][p] =
          mean.diffuse_q * (s == 0 ? at.diffuse_transmittance[p] : at.sight_diffuse[s - 1][p]);
      if (!sunlit_) continue;
      const double mu = std::cos(all[s].zenith_rad);
      const StokesVector once =
          points_.irradiance[p] *
          single_scattering(column, options_.aerosol_polarization,
                            {mu, all[s].azimuth_rad - std::numbers::pi}, geometry_.sensor_altitude_km,
                            sight_length_km(geometry_, ground_km, all[s].height_km, mu))
              .single;
      const double rest = (s == 0 ? at.path[p] : at.sight_path[s - 1][p]) - once.i;
      at.path_q[s][p] = once.q + rest * mean.q;
      at.path_u[s][p] = once.u + rest * mean.u;
    }
  }
}

}  // namespace ifov::atmosphere
