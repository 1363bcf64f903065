#include "studies/atmosphere/environment_figures.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/ground_spread.h"
#include "atmosphere/scattering/phase/phase_function.h"
#include "studies/common/figures.h"

namespace ifov::studies {
namespace {

using namespace atmosphere;

/// Of 6S for a sensor above the air that looks down, r in km (Vermote et al. 1997, subroutine ENVIRO).
double molecules_of_6s(double r) { return 1.0 - 0.930 * std::exp(-0.080 * r) - 0.070 * std::exp(-1.100 * r); }
double haze_of_6s(double r) { return 1.0 - 0.448 * std::exp(-0.27 * r) - 0.552 * std::exp(-2.83 * r); }

/// Layers that grow thicker upwards, of an exponential profile.
GroundSpread spread_of(double scale_km, double depth, const AerosolPhases* phases) {
  std::vector<double> altitude{0.0};
  LayerOptics optics;
  auto own = phases ? std::make_shared<AerosolPhases>() : nullptr;
  if (own) own->functions = phases->functions;
  for (int k = 0; k < 80; ++k) {
    const double low = altitude.back(), high = low + 0.1 * std::pow(1.05, k);
    const double share = depth * (std::exp(-low / scale_km) - std::exp(-high / scale_km));
    altitude.push_back(high);
    optics.rayleigh_scattering.push_back(phases ? 0.0 : share);
    optics.aerosol_scattering.push_back(phases ? share : 0.0);
    optics.aerosol_asymmetry.push_back(0.65);
    optics.gas_absorption.push_back(0.0);
    optics.aerosol_absorption.push_back(0.0);
    if (own)
      own->share.insert(own->share.end(), phases->shares(0), phases->shares(0) + phases->functions.size());
  }
  optics.aerosol_phases = own;
  return {altitude, optics, {}, 1 << 16};
}

/// F(r) of light scattered once (docs/theory/atmosphere_adjacency.md, equation 3).
double scattered_once(const PhaseFunction& phase, double scale_km, double r_km) {
  constexpr int kSteps = 2000;
  double inside = 0.0, all = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double u = (k + 0.5) / kSteps, theta = 0.5 * std::numbers::pi * u * u * u;
    const double share = u * u * phase.at(std::cos(theta)) * std::sin(theta);
    all += share;
    inside -= share * std::expm1(-r_km / (scale_km * std::tan(theta)));
  }
  return inside / all;
}

template <class Expected>
double largest(const GroundSpread& spread, const Expected& expected, double from_km, double to_km) {
  double worst = 0.0;
  for (double r = from_km; r <= to_km * 1.001; r *= 1.2)
    worst = std::max(worst, std::abs(spread.within(r) - expected(r)));
  return worst;
}

}  // namespace

void add_environment_figures(FigureTable& figures) {
  const AtmosphereColumn rural{AtmosphereDescription{}};
  const AerosolPhases phases = *rural.at(1e4 / 0.55).scattering.aerosol_phases;
  const GroundSpread thin = spread_of(2.0, 1e-4, &phases), haze = spread_of(2.0, 0.1, &phases);
  const auto once = [&](double r) { return scattered_once(phases.functions[0], 2.0, r); };
  figures.at_most("environment_molecules", largest(spread_of(8.0, 0.1, nullptr), molecules_of_6s, 0.05, 10.0),
                  0.03, "", "environment function F(r) of molecules against 6S, 0.05 to 10 km");
  figures.at_most("environment_haze", largest(haze, haze_of_6s, 2.0, 100.0), 0.03, "",
                  "of haze (rural, scale height 2 km) against 6S, 2 to 100 km");
  figures.report("environment_haze_near", largest(haze, haze_of_6s, 0.02, 2.0), "", "the same, 0.02 to 2 km");
  figures.at_most("environment_haze_closed", largest(thin, once, 0.02, 100.0), 0.03, "",
                  "of thin haze against light scattered once in closed form, 0.02 to 100 km");
  double theirs = 0.0;
  for (double r = 0.02; r <= 2.0; r *= 1.2) theirs = std::max(theirs, std::abs(haze_of_6s(r) - once(r)));
  figures.report("environment_6s_closed", theirs, "", "6S against the same, 0.02 to 2 km");
}

}  // namespace ifov::studies
