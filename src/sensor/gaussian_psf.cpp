#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

class GaussianPsf final : public Psf {
 public:
  GaussianPsf(double sigma_px, double cut_sigmas)
      : sigma_px_(sigma_px), cut_sigmas_(cut_sigmas), kept_(std::erf(cut_sigmas / std::numbers::sqrt2)) {}

  double half_width_px() const override { return sigma_px_ * cut_sigmas_; }
  double detail_px() const override { return sigma_px_; }

  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return along(x0_px, x1_px) * along(y0_px, y1_px);
  }

  bool separable() const override { return true; }
  double kept() const override { return kept_ * kept_; }
  double cut_density(double dx_px, double dy_px, bool) const override {
    const double x = dx_px / sigma_px_, y = dy_px / sigma_px_;
    if (std::max(std::abs(x), std::abs(y)) <= cut_sigmas_) return 0.0;
    return std::exp(-0.5 * (x * x + y * y)) / (2.0 * std::numbers::pi * sigma_px_ * sigma_px_);
  }

  std::string description() const override {
    return format("Gaussian of sigma {:g} px, cut at {:g} px, which leaves out {:.2g} % of the energy",
                  sigma_px_, half_width_px(), 100.0 * (1.0 - kept_ * kept_));
  }

 private:
  double along(double a_px, double b_px) const { return 0.5 * (cumulative(b_px) - cumulative(a_px)); }
  double cumulative(double x_px) const {
    const double t = x_px / sigma_px_;
    if (std::abs(t) >= cut_sigmas_) return std::copysign(1.0, t);
    return std::erf(t / std::numbers::sqrt2) / kept_;
  }

  double sigma_px_, cut_sigmas_, kept_;  // kept: share along one axis
};

}  // namespace

std::unique_ptr<Psf> make_gaussian_psf(double sigma_px, double cut_sigmas) {
  if (!(sigma_px > 0.0) || !(sigma_px <= 100.0))
    throw InputError(format("a Gaussian PSF of sigma {} px; expected more than 0 and at most 100", sigma_px));
  if (!(cut_sigmas >= 1.0) || !(cut_sigmas <= 8.0))
    throw InputError(format("a Gaussian PSF cut at {} sigma; expected 1 to 8", cut_sigmas));
  return std::make_unique<GaussianPsf>(sigma_px, cut_sigmas);
}

}  // namespace ifov::sensor
