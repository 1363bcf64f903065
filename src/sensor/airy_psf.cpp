#include <cmath>
#include <numbers>

#include "core/error.h"
#include "sensor/airy_aperture.h"
#include "sensor/energy_table.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

/// Share of the energy within v = pi r / q of a circular aperture (Born & Wolf, 8.5.2, equation 18).
double encircled(double v) {
  const double j0 = std::cyl_bessel_j(0.0, v), j1 = std::cyl_bessel_j(1.0, v);
  return 1.0 - j0 * j0 - j1 * j1;
}

/// Relative intensity [2 J1(v) / v]^2.
double intensity(double v) {
  if (v < 1e-4) return 1.0 - v * v / 4.0;
  const double a = 2.0 * std::cyl_bessel_j(1.0, v) / v;
  return a * a;
}

/// The same without its rings: their mean, 4 / (pi v^3).
double smooth_intensity(double v) { return 4.0 / (std::numbers::pi * v * v * v); }

/// Far out, by two terms of Hankel's expansion of J1 (Abramowitz and Stegun 9.2.1): right within 1e-4 from v = 25 on.
double far_intensity(double v) {
  const double phase = v - 0.75 * std::numbers::pi, slow = 3.0 / (8.0 * v);
  const double wave = std::cos(phase) - slow * std::sin(phase);
  return 8.0 / (std::numbers::pi * v * v * v) * wave * wave;
}

constexpr double kFar = 25.0;
constexpr double kCellsPerQ = 24.0;  // the first dark ring lies at 1.22 q
constexpr int kMostPupilCells = 2048;
constexpr double kMostObscured = 0.95;

/// A circular aperture whose middle is covered: intensities in those of the open one's centre, so that an aperture of the
/// same energy has 1 / (1 - e^2) times as much.
class Pattern {
 public:
  explicit Pattern(double obscuration) : e_(obscuration) {}

  double at(double v) const {
    if (e_ == 0.0) return intensity(v);
    const double a = amplitude(v) - e_ * e_ * amplitude(e_ * v);
    return a * a / (1.0 - e_ * e_);
  }
  double far(double v) const {
    if (e_ == 0.0) return v < kFar ? intensity(v) : far_intensity(v);
    return at(v);
  }
  /// Without the rings of its rim; those by which the waves of both rims beat are slower, and stay.
  double smooth(double v) const {
    if (e_ == 0.0) return smooth_intensity(v);
    const double beat = 2.0 * std::sqrt(e_) * std::cos((1.0 - e_) * v);
    return smooth_intensity(v) * (1.0 + e_ - beat) / (1.0 - e_ * e_);
  }
  /// v within which this share of the energy falls.
  double radius(double energy) const {
    if (e_ == 0.0) {
      double low = 0.0, high = 1.0;
      while (encircled(high) < energy) high *= 2.0;
      for (int i = 0; i < 100; ++i)
        (encircled(0.5 * (low + high)) < energy ? low : high) = 0.5 * (low + high);
      return high;
    }
    // dE = I v dv / 2, by Simpson's rule.
    constexpr double kStep = 0.05;
    double v = 0.0, sum = 0.0, before = 0.0;
    for (;;) {
      const double middle = at(v + 0.5 * kStep) * (v + 0.5 * kStep), end = at(v + kStep) * (v + kStep);
      const double more = kStep / 12.0 * (before + 4.0 * middle + end);
      if (sum + more >= energy) return v + kStep * (energy - sum) / more;
      sum += more, before = end, v += kStep;
    }
  }

 private:
  /// 2 J1(v) / v.
  static double amplitude(double v) { return v < 1e-4 ? 1.0 - v * v / 8.0 : 2.0 * bessel_1(v) / v; }
  /// Far out by Hankel's expansion, as far_intensity().
  static double bessel_1(double v) {
    if (v < kFar) return std::cyl_bessel_j(1.0, v);
    const double phase = v - 0.75 * std::numbers::pi, slow = 3.0 / (8.0 * v);
    return std::sqrt(2.0 / (std::numbers::pi * v)) * (std::cos(phase) - slow * std::sin(phase));
  }

  double e_;
};

/// Energy of each cell by 3 x 3 Gauss points, none beyond the cut radius.
EnergyTable tabulate(const Pattern& pattern, double q_px, double radius_px) {
  const int cells =
      2 * static_cast<int>(std::ceil(std::min(radius_px / q_px * kCellsPerQ, 0.5 * kMostPupilCells)));
  const double cell_px = 2.0 * radius_px / cells;
  constexpr double kNode = 0.7745966692414834;
  constexpr double kNodes[] = {-kNode, 0.0, kNode}, kWeights[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

  // One radial table serves all cells: Bessel functions are slow.
  const int steps = 64 * cells;
  std::vector<double> radial(static_cast<std::size_t>(steps) + 2);
  for (std::size_t i = 0; i < radial.size(); ++i)
    radial[i] = pattern.at(std::numbers::pi * radius_px * static_cast<double>(i) / steps / q_px);
  const auto at = [&](double r_px) {
    const double t = r_px / radius_px * steps;
    const auto i = static_cast<std::size_t>(t);
    const double f = t - static_cast<double>(i);
    return (1.0 - f) * radial[i] + f * radial[i + 1];
  };

  std::vector<double> energy;
  energy.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      double sum = 0.0;
      for (int b = 0; b < 3; ++b)
        for (int a = 0; a < 3; ++a) {
          const double x = (i + 0.5 + 0.5 * kNodes[a]) * cell_px - radius_px;
          const double y = (j + 0.5 + 0.5 * kNodes[b]) * cell_px - radius_px;
          const double r = std::hypot(x, y);
          if (r <= radius_px) sum += kWeights[a] * kWeights[b] * at(r);
        }
      energy.push_back(sum);
    }
  return {cells, cells, cell_px, energy};
}

class AiryPsf final : public Psf {
 public:
  AiryPsf(double q_px, double obscuration, double kept)
      : q_px_(q_px),
        obscuration_(obscuration),
        kept_(kept),
        pattern_(obscuration),
        radius_px_(pattern_.radius(kept) * q_px / std::numbers::pi),
        table_(tabulate(pattern_, q_px, radius_px_)) {}

  double half_width_px() const override { return radius_px_; }
  double detail_px() const override { return 0.5 * q_px_; }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return table_.within(x0_px, y0_px, x1_px, y1_px);
  }
  double kept() const override { return kept_; }
  bool has_wings() const override { return true; }
  double cut_density(double dx_px, double dy_px, bool smooth) const override {
    const double r = std::hypot(dx_px, dy_px), v = std::numbers::pi * r / q_px_;
    if (r <= radius_px_) return 0.0;
    const double relative = smooth ? pattern_.smooth(v) : pattern_.far(v);
    return 0.25 * std::numbers::pi / (q_px_ * q_px_) * relative;
  }
  std::string description() const override {
    if (obscuration_ > 0.0)
      return format(
          "Airy pattern of an aperture covered to {:g} of its diameter, wavelength times f-number {:.4g} px, traced to {:.4g} px; "
          "the {:.2g} % of the energy beyond are wings",
          obscuration_, q_px_, radius_px_, 100.0 * (1.0 - kept_));
    return format(
        "Airy pattern, first dark ring at {:.4g} px, traced to {:.4g} px; the {:.2g} % of the energy beyond are wings",
        1.2196698912665045 * q_px_, radius_px_, 100.0 * (1.0 - kept_));
  }

 private:
  double q_px_, obscuration_, kept_;
  Pattern pattern_;
  double radius_px_;
  EnergyTable table_;
};

}  // namespace

namespace {

constexpr double kLeastTraced = 0.95, kMostTraced = 0.995;

/// Wavelength times f-number, px.
double checked_q_px(const AiryAperture& aperture) {
  for (const double value :
       {aperture.wavelength_um, aperture.diameter_m, aperture.focal_length_m, aperture.pitch_m})
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError(
          "an Airy PSF needs a positive wavelength, aperture diameter, focal length and detector pitch");
  if (!(aperture.obscuration >= 0.0) || !(aperture.obscuration <= kMostObscured))
    throw InputError(format("an Airy PSF with {} of its aperture's diameter covered; expected 0 to {}",
                            aperture.obscuration, kMostObscured));
  const double q_px =
      aperture.wavelength_um * 1e-6 * aperture.focal_length_m / (aperture.diameter_m * aperture.pitch_m);
  if (!(q_px > 1e-3) || !(q_px < 100.0))
    throw InputError(
        format("an Airy PSF with its first dark ring at {:.3g} px; expected 0.001 to 100 px", 1.22 * q_px));
  return q_px;
}

}  // namespace

double airy_energy_to_trace(const AiryAperture& aperture) {
  constexpr double kFar_px = 0.45;
  const double q_px = checked_q_px(aperture);
  const Pattern pattern(aperture.obscuration);
  const auto reaches = [&](double energy) {
    return pattern.radius(energy) * q_px / std::numbers::pi >= kFar_px;
  };
  if (reaches(kLeastTraced)) return kLeastTraced;
  if (!reaches(kMostTraced)) return kMostTraced;
  double low = kLeastTraced, high = kMostTraced;
  for (int k = 0; k < 12; ++k) (reaches(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return low;
}

std::unique_ptr<Psf> make_airy_psf(const AiryAperture& aperture, double encircled_energy) {
  const double q_px = checked_q_px(aperture);
  if (!(encircled_energy >= 0.5) || !(encircled_energy <= kMostTraced))
    throw InputError(
        format("an Airy PSF cut at {} of its energy; expected 0.5 to {}", encircled_energy, kMostTraced));
  return std::make_unique<AiryPsf>(q_px, aperture.obscuration, encircled_energy);
}

}  // namespace ifov::sensor
