#include <cstdio>
#include <numbers>

#include "figure_data.h"
#include "geodesy/geodetic.h"
#include "geodesy/orbit/sgp4.h"
#include "geodesy/orbit/teme.h"

namespace ifov::figures {

/// CBERS 2, of the verification of Vallado et al. (2006).
void print_orbit() {
  constexpr double kDegree = std::numbers::pi / 180.0, kStep_min = 0.5, kMinutesPerDay = 1440.0;
  constexpr double kBegin_min = 903.5;  // on its way north over the equator
  const geodesy::Sgp4 orbit(geodesy::parse_two_line_elements(
      "1 28057U 03049A   06177.78615833  .00000060  00000-0  35940-4 0  1836",
      "2 28057  98.4283 247.6961 0000884  88.1964 271.9322 14.35478080140550"));
  const geodesy::UtcTime epoch = orbit.elements().epoch;
  for (int k = 0; k * kStep_min <= 3.0 * kMinutesPerDay / 14.35478080; ++k) {
    const double minutes = kBegin_min + k * kStep_min;
    const geodesy::OrbitState state = orbit.after_minutes(minutes);
    const auto turn = geodesy::ecef_from_teme({epoch.jd1, epoch.jd2 + minutes / kMinutesPerDay});
    const geodesy::Geodetic below = geodesy::geodetic_from_ecef(turn(state.position));
    const auto greenwich = turn.inverse()(geodesy::EcefVector{{1.0, 0.0, 0.0}});
    std::printf("orbit %.1f %.4f %.4f %.1f %.0f %.0f %.0f %.2f %.2f %.2f %.6f %.6f\n", k * kStep_min,
                below.latitude_rad / kDegree, below.longitude_rad / kDegree, below.height_m,
                state.position.p.x, state.position.p.y, state.position.p.z, state.velocity_m_s.v.x,
                state.velocity_m_s.v.y, state.velocity_m_s.v.z, greenwich.v.x, greenwich.v.y);
  }
}

}  // namespace ifov::figures
