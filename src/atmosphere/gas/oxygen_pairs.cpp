#include "atmosphere/gas/oxygen_pairs.h"

#include <cmath>
#include <numbers>

#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {
namespace {

struct PairBand {
  double centre_nm;
  double peak_1e46_cm5;  ///< cross section per pair of oxygen molecules
  double fwhm_nm;
};

constexpr PairBand kGreenblatt[] = {{343.4, 1.20, 4.2},   {360.5, 4.10, 4.8},  {380.2, 2.40, 4.4},
                                    {446.7, 0.57, 5.6},   {477.3, 6.30, 6.2},  {532.2, 1.00, 10.2},
                                    {577.2, 11.00, 11.6}, {630.0, 7.20, 13.8}, {1065.2, 12.00, 27.3}};

/// Mate et al.: strengths of pairs with oxygen and with nitrogen, cm-2 per (molecule cm-3)^2, about the
/// origin of the band; the peak of the first is that of the table that was made from it (Karman et al.,
/// Icarus 328 (2019) 160-175).
constexpr double kOrigin_cm1 = 7882.4, kWithOxygen = 4.847e-43, kWithNitrogen = 0.941e-43,
                 kPeak_cm5 = 2.131e-45;
constexpr double kNitrogenPerOxygen = 0.781 / 0.20946;

/// 1 at its centre and 1/2 at half the width beside it.
double gaussian(double distance, double fwhm) {
  const double x = 2.0 * distance / fwhm;
  return std::exp2(-x * x);
}

}  // namespace

double oxygen_pair_depth(double wavenumber_cm1) {
  double cross_section = 0.0;  // cm5
  for (const PairBand& band : kGreenblatt)
    cross_section +=
        1e-46 * band.peak_1e46_cm5 * gaussian(1e7 / wavenumber_cm1 - band.centre_nm, band.fwhm_nm);
  static const double fwhm_cm1 =
      kWithOxygen / kPeak_cm5 * 2.0 * std::sqrt(std::numbers::ln2 / std::numbers::pi);
  cross_section += kPeak_cm5 * (1.0 + kWithNitrogen / kWithOxygen * kNitrogenPerOxygen) *
                   gaussian(wavenumber_cm1 - kOrigin_cm1, fwhm_cm1);
  constexpr double kCmPerKm = 1e5;
  return cross_section * kLoschmidtCm3 * kLoschmidtCm3 * kCmPerKm;
}

}  // namespace ifov::atmosphere
