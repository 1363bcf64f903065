#include "materials/bsdf/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ifov::materials {
namespace {

constexpr int kAcross = 64;           // directions along each side of the unit square
constexpr int kAzimuths = 8;          // of models with a direction
constexpr double kNegligible = 1e-6;  // of all light
constexpr int kViewAngles = 12;       // of bihemispherical values

/// Numbers of the unit interval that crowd at its ends, where directions graze and integrands are least smooth, and what
/// each counts (the polynomial transformation of Korobov 1963 of fifth degree, for the midpoint rule: exact of a constant within
/// 1e-7).
struct Crowded {
  double u, weight;
};
Crowded crowded(int k) {
  const double t = (k + 0.5) / kAcross;
  const double both = t * (1.0 - t);
  return {t * t * t * (10.0 - t * (15.0 - 6.0 * t)), 30.0 * both * both / kAcross};
}

}  // namespace

void directional_hemispherical(const Bsdf& bsdf, Side side, ParameterSpectra parameters, std::size_t count,
                               double cosine, float* spectrum) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const int azimuths = bsdf.is_isotropic() ? 1 : kAzimuths;
  std::vector<double> sum(count, 0.0);
  std::vector<float> values(count);
  const auto add_part = [&](BsdfEvent event, double first, double last) {
    if (!(last > first)) return;
    for (int i = 0; i < kAcross; ++i)
      for (int j = 0; j < kAcross; ++j) {
        const Crowded x = crowded(i), y = crowded(j);
        const BsdfSample sample = bsdf.sample(event, first + (last - first) * x.u, y.u);
        if (!(sample.weight > 0.0)) continue;
        event.incoming = sample.incoming;
        bsdf.evaluate(event, parameters, count, values.data());
        const double weight = (last - first) * x.weight * y.weight * sample.weight;
        for (std::size_t n = 0; n < count; ++n) sum[n] += weight * static_cast<double>(values[n]);
      }
  };
  for (int a = 0; a < azimuths; ++a) {
    const double azimuth = 2.0 * std::numbers::pi * a / azimuths;
    BsdfEvent event;
    event.outgoing = {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
    event.normal = {0.0, 0.0, 1.0};
    event.tangent = {1.0, 0.0, 0.0};
    event.side = side;
    // Each lobe by itself, as far as it counts for anything.
    const double seam = bsdf.seam(event);
    add_part(event, kNegligible < seam ? 0.0 : seam, seam);
    add_part(event, seam, 1.0);
  }
  for (std::size_t n = 0; n < count; ++n) spectrum[n] = static_cast<float>(sum[n] / azimuths);
}

radiometry::Spectrum directional_hemispherical(const Bsdf& bsdf, Side side, double cosine) {
  std::vector<const radiometry::Spectrum*> spectra;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra()) spectra.push_back(&spectrum);
  radiometry::CommonWavelengths common = radiometry::common_wavelengths(spectra);
  const bool constant = common.um.empty();
  if (constant) common.um.push_back(1.0);
  std::vector<std::vector<float>> rows;
  std::vector<const float*> parameters;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra()) {
    std::vector<float>& row = rows.emplace_back();
    for (const double um : common.um) row.push_back(static_cast<float>(spectrum.at(um)));
  }
  for (const std::vector<float>& row : rows) parameters.push_back(row.data());

  std::vector<double> values(common.um.size(), 0.0);
  std::vector<float> row(values.size());
  const auto add = [&](double towards, double weight) {
    directional_hemispherical(bsdf, side, parameters, row.size(), towards, row.data());
    for (std::size_t k = 0; k < row.size(); ++k) values[k] += weight * static_cast<double>(row[k]);
  };
  if (cosine >= 0.0) {
    add(cosine, 1.0);
  } else {
    // By equal shares of projected solid angle.
    for (int k = 0; k < kViewAngles; ++k) add(std::sqrt((k + 0.5) / kViewAngles), 1.0 / kViewAngles);
  }
  if (constant) return radiometry::Spectrum::constant(values[0]);
  return {std::move(common.um), std::move(values), common.outside, spectra.front()->name()};
}

}  // namespace ifov::materials
