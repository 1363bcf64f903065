#include "materials/bsdf/bsdf_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::materials {

using std::numbers::pi;

namespace {

double degrees(double rad) { return rad * 180.0 / pi; }

/// Linear in both zenith angles, as far as the table goes.
double between_zeniths(const MeasuredBrdf& m, double in, double out, std::size_t azimuth,
                       std::size_t wavelength) {
  const Bracket i = bracket(m.zenith_in_rad, in), o = bracket(m.zenith_out_rad, out);
  double sum = 0.0;
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b) {
      const double weight = (a ? i.share : 1.0 - i.share) * (b ? o.share : 1.0 - o.share);
      if (weight > 0.0) sum += weight * m.at(i.below + a, o.below + b, azimuth, wavelength);
    }
  return sum;
}

bool is_covered(const std::vector<double>& rising, double value) {
  return value >= rising.front() - 1e-12 && value <= rising.back() + 1e-12;
}

}  // namespace

Bracket bracket(const std::vector<double>& rising, double value) {
  if (rising.size() == 1 || value <= rising.front()) return {0, 0.0};
  if (value >= rising.back()) return {rising.size() - 2, 1.0};
  const auto above =
      static_cast<std::size_t>(std::upper_bound(rising.begin(), rising.end(), value) - rising.begin());
  return {above - 1, (value - rising[above - 1]) / (rising[above] - rising[above - 1])};
}

BsdfTable::BsdfTable(const MeasuredBrdf& measured, bool repair)
    : azimuth_rad_(measured.azimuth_rad), wavelength_um_(measured.wavelength_um) {
  std::set_union(measured.zenith_in_rad.begin(), measured.zenith_in_rad.end(),
                 measured.zenith_out_rad.begin(), measured.zenith_out_rad.end(),
                 std::back_inserter(zenith_rad_));
  if (static_cast<double>(zenith_rad_.size()) * static_cast<double>(zenith_rad_.size() + 1) / 2.0 *
          static_cast<double>(azimuth_rad_.size()) >
      static_cast<double>(kMostRows))
    throw InputError(
        format("{} zenith angles of light and view together and {} azimuths make more than {} pairs of "
               "directions; thin them",
               zenith_rad_.size(), azimuth_rad_.size(), kMostRows));
  brdf_.resize(row_count() * wavelength_um_.size());
  make_reciprocal(measured, repair);
  make_passive(repair);
}

void BsdfTable::make_reciprocal(const MeasuredBrdf& m, bool repair) {
  const double floor = 0.01 * *std::max_element(m.brdf.begin(), m.brdf.end());
  struct {
    double asymmetry = 0.0, a = 0.0, b = 0.0, there = 0.0, back = 0.0;
    std::size_t azimuth = 0, wavelength = 0;
  } worst;
  for (std::size_t i = 0; i < zenith_rad_.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j)
      for (std::size_t k = 0; k < azimuth_rad_.size(); ++k)
        for (std::size_t n = 0; n < wavelength_um_.size(); ++n) {
          const double a = zenith_rad_[i], b = zenith_rad_[j];
          const double there = between_zeniths(m, a, b, k, n), back = between_zeniths(m, b, a, k, n);
          const bool is_there = is_covered(m.zenith_in_rad, a) && is_covered(m.zenith_out_rad, b),
                     is_back = is_covered(m.zenith_in_rad, b) && is_covered(m.zenith_out_rad, a);
          // Where one of them was not measured the other stands for both.
          const double mean = is_there == is_back ? 0.5 * (there + back) : is_there ? there : back;
          brdf_[row(i, j, k) * wavelength_um_.size() + n] = mean;
          if (!(is_there && is_back)) continue;
          const double asymmetry = std::abs(there - back) / std::max(mean, floor);
          if (asymmetry > worst.asymmetry) worst = {asymmetry, a, b, there, back, k, n};
        }
  if (worst.asymmetry <= kMostAsymmetry) return;
  const std::string what = format(
      "at {:g} um light from {:g} deg seen from {:g} deg, azimuth {:g} deg, has a BRDF of {:.4g} /sr, and with both "
      "exchanged {:.4g}",
      wavelength_um_[worst.wavelength], degrees(worst.a), degrees(worst.b),
      degrees(azimuth_rad_[worst.azimuth]), worst.there, worst.back);
  if (!repair)
    throw InputError(format("not reciprocal by {:.3g} %: {}; \"repair\": true takes the mean",
                            100.0 * worst.asymmetry, what));
  changes_.push_back(format("the mean of both directions is taken, which differ by up to {:.3g} %: {}",
                            100.0 * worst.asymmetry, what));
}

std::vector<double> BsdfTable::directional_hemispherical(std::size_t zenith) const {
  constexpr int kZeniths = 180, kAzimuths = 90;
  std::vector<double> sum(wavelength_um_.size(), 0.0);
  for (int i = 0; i < kZeniths; ++i) {
    const double theta = 0.5 * pi * (i + 0.5) / kZeniths;
    const double ring = std::sin(theta) * std::cos(theta) * 0.5 * pi / kZeniths * 2.0 * pi / kAzimuths;
    const Bracket z = bracket(zenith_rad_, theta);
    for (int j = 0; j < kAzimuths; ++j) {
      const Bracket p = bracket(azimuth_rad_, pi * (j + 0.5) / kAzimuths);
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b) {
          const double weight = ring * (a ? z.share : 1.0 - z.share) * (b ? p.share : 1.0 - p.share);
          if (!(weight > 0.0)) continue;
          const double* values = brdf(zenith, z.below + a, p.below + b);
          for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += weight * values[n];
        }
    }
  }
  return sum;
}

void BsdfTable::make_passive(bool repair) {
  const std::size_t count = wavelength_um_.size();
  std::vector<double> most(count, 0.0);
  std::vector<std::size_t> where(count, 0);
  for (std::size_t z = 0; z < zenith_rad_.size(); ++z) {
    const std::vector<double> whole = directional_hemispherical(z);
    for (std::size_t n = 0; n < count; ++n)
      if (whole[n] > most[n]) {
        most[n] = whole[n];
        where[n] = z;
      }
  }
  const auto n = static_cast<std::size_t>(std::max_element(most.begin(), most.end()) - most.begin());
  if (most[n] <= kMostReflectance) return;
  const std::string what = format("at {:g} um it sends back {:.4g} times what comes {:g} deg from the normal",
                                  wavelength_um_[n], most[n], degrees(zenith_rad_[where[n]]));
  if (!repair) throw InputError(format("{}; \"repair\": true scales such wavelengths down", what));
  std::size_t scaled = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (most[k] <= kMostReflectance) continue;
    ++scaled;
    for (std::size_t r = 0; r < row_count(); ++r) brdf_[r * count + k] /= most[k];
  }
  changes_.push_back(format("{} of {} wavelengths are scaled down until no more comes back than arrives: {}",
                            scaled, count, what));
}

}  // namespace ifov::materials
