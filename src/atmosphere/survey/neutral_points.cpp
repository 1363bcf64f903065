#include "atmosphere/survey/neutral_points.h"

#include <algorithm>
#include <numbers>
#include <optional>

namespace ifov::atmosphere {
namespace {

/// Q along the circle through Sun and zenith, where U is 0.
struct Circle {
  std::vector<double> zenith_rad, q;

  explicit Circle(const SkyView& sky) {
    const std::size_t rings = sky.zenith_rad.size(), opposite = sky.azimuth_rad.size() - 1;
    // The horizon itself is left out: light there comes from the whole depth of the air.
    for (std::size_t z = rings - 1; z-- > 0;) add(sky.zenith_rad[z], sky.at(z, 0).q);
    for (std::size_t z = 1; z + 1 < rings; ++z) add(-sky.zenith_rad[z], sky.at(z, opposite).q);
  }

  void add(double zenith, double value) {
    zenith_rad.push_back(zenith);
    q.push_back(value);
  }

  /// Zenith angles at which Q changes its sign.
  std::vector<double> roots() const {
    std::vector<double> found;
    for (std::size_t k = 0; k + 1 < q.size(); ++k)
      if ((q[k] > 0.0) != (q[k + 1] > 0.0))
        found.push_back(zenith_rad[k] + (zenith_rad[k + 1] - zenith_rad[k]) * q[k] / (q[k] - q[k + 1]));
    return found;
  }
};

}  // namespace

std::vector<NeutralPoint> neutral_points(const SkyView& sky, double sun_zenith_rad) {
  const double opposite = sun_zenith_rad - std::numbers::pi;
  std::optional<NeutralPoint> brewster, babinet, arago;
  for (const double zenith : Circle(sky).roots()) {
    const double from_sun = sun_zenith_rad - zenith, from_opposite = zenith - opposite;
    // Above the Sun the nearest counts, and so it does below it and above the point opposite.
    if (from_sun < 0.0)
      brewster = NeutralPoint{"Brewster", zenith, -from_sun};
    else if (from_sun < from_opposite)
      babinet = babinet ? babinet : NeutralPoint{"Babinet", zenith, from_sun};
    else
      arago = NeutralPoint{"Arago", zenith, from_opposite};
  }
  std::vector<NeutralPoint> points;
  for (const auto& point : {brewster, babinet, arago})
    if (point) points.push_back(*point);
  return points;
}

}  // namespace ifov::atmosphere
