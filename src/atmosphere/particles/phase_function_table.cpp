#include "atmosphere/particles/phase_function_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/scattering/phase/scattering_matrix.h"

namespace ifov::atmosphere {
namespace {

/// Every half degree to 10, every degree to 30, every 3 degrees beyond.
std::shared_ptr<const PhaseAngles> made_angles() {
  std::vector<double> angle_rad;
  for (int k = 0; k <= 90; ++k) {
    const double degrees = k <= 20 ? 0.5 * k : k <= 40 ? k - 10.0 : 30.0 + 3.0 * (k - 40);
    angle_rad.push_back(degrees * std::numbers::pi / 180.0);
  }
  return std::make_shared<const PhaseAngles>(std::move(angle_rad));
}

}  // namespace

PhaseFunction PhaseFunctionTable::at(double um,
                                     std::shared_ptr<const PolarizationRatios> polarization) const {
  const std::vector<double>& x = wavelength_um;
  const std::size_t above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), um) - x.begin());
  if (above == 0 || above == x.size())
    return {angles, logarithms[above == 0 ? 0 : above - 1], std::move(polarization)};
  const double longer = (um - x[above - 1]) / (x[above] - x[above - 1]);
  std::vector<double> values(angles->angle_rad.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = std::lerp(logarithms[above - 1][k], logarithms[above][k], longer);
  return {angles, std::move(values), std::move(polarization)};
}

PhaseFunction henyey_greenstein(double asymmetry) {
  static const std::shared_ptr<const PhaseAngles> angles = made_angles();
  static const auto none =
      std::make_shared<const PolarizationRatios>(PolarizationRatios::none(angles->angle_rad));
  std::vector<double> logarithms;
  for (const double angle : angles->angle_rad)
    logarithms.push_back(std::log(aerosol_matrix(std::cos(angle), asymmetry, 0.0).a1));
  return {angles, std::move(logarithms), none};
}

}  // namespace ifov::atmosphere
