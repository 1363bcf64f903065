#include <cmath>

#include "core/format.h"
#include "io/atmosphere_report/atmosphere_report.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

void add_row(std::string& text, double zenith_rad, double azimuth_rad,
             const radiometry::StokesVector& light) {
  double azimuth_deg = std::fmod(azimuth_rad / math::kDegree + 720.0, 360.0);
  if (azimuth_deg > 360.0 - 1e-9) azimuth_deg = 0.0;
  const double angle_deg = radiometry::angle_of_linear_polarization_rad(light) / math::kDegree;
  text +=
      format("{:.6g},{:.6g},{:.7g},{:.7g},{:.7g},{:.5f},{:.2f}\n", zenith_rad / math::kDegree, azimuth_deg,
             light.i, light.q, light.u, radiometry::degree_of_linear_polarization(light), angle_deg);
}

}  // namespace

std::string sky_csv(const AtmosphereReport& report) {
  const atmosphere::SkyView& sky = *report.sky;
  std::string text;
  for (const std::string& line : report.description) text += "# " + line + "\n";
  text += format("# sky seen from the ground at {:.6g} um ({}), over black ground, without the disc\n",
                 sky.wavelength_um, report.sky_channel);
  text +=
      "# zenith angle; azimuth clockwise from north; radiance, q and u in W m-2 sr-1 um-1, q > 0 where light "
      "swings "
      "in the\n# vertical plane; degree of linear polarization; its angle, counterclockwise from the "
      "vertical as one "
      "looks there\n"
      "zenith_deg,azimuth_deg,radiance,q,u,polarization,polarization_angle_deg\n";
  const double sun = report.sun_azimuth_rad.value_or(0.0);
  for (std::size_t z = 0; z < sky.zenith_rad.size(); ++z) {
    // The table's azimuths run counterclockwise from the Sun's; the other side is its mirror image.
    for (std::size_t a = sky.azimuth_rad.size(); a-- > 0;)
      add_row(text, sky.zenith_rad[z], sun - sky.azimuth_rad[a], sky.at(z, a));
    for (std::size_t a = 1; a + 1 < sky.azimuth_rad.size(); ++a) {
      radiometry::StokesVector light = sky.at(z, a);
      light.u = -light.u;
      add_row(text, sky.zenith_rad[z], sun + sky.azimuth_rad[a], light);
    }
  }
  return text;
}

}  // namespace ifov::io
