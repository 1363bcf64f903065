#include "sensor/optics/halo.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

class HaloPsf final : public Psf {
 public:
  HaloPsf(std::unique_ptr<const Psf> psf, const Halo& halo) : psf_(std::move(psf)), halo_(halo) {}

  double half_width_px() const override { return psf_ ? psf_->half_width_px() : 0.0; }
  double detail_px() const override {
    constexpr double kSmooth_px = 0.5;
    return psf_ ? psf_->detail_px() : kSmooth_px;
  }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    if (psf_) return psf_->energy(x0_px, y0_px, x1_px, y1_px);
    return x0_px <= 0.0 && x1_px > 0.0 && y0_px <= 0.0 && y1_px > 0.0 ? 1.0 : 0.0;
  }
  double kept() const override { return (1.0 - halo_.share) * (psf_ ? psf_->kept() : 1.0); }
  double cut_density(double dx_px, double dy_px, bool smooth) const override {
    const double a = halo_.scale_px(), square = dx_px * dx_px + dy_px * dy_px + a * a;
    const double halo = a / (2.0 * std::numbers::pi * square * std::sqrt(square));
    return halo_.share * halo + (psf_ ? (1.0 - halo_.share) * psf_->cut_density(dx_px, dy_px, smooth) : 0.0);
  }
  bool has_wings() const override { return true; }
  bool round() const override { return !psf_ || psf_->round(); }
  bool separable() const override { return psf_ && psf_->separable(); }
  bool mirrored() const override { return !psf_ || psf_->mirrored(); }
  std::string description() const override {
    return format("{}; {:.3g} % of the light in a halo, half of which lies within {:.4g} px",
                  psf_ ? psf_->description() : "no blur", 100.0 * halo_.share, halo_.radius_px);
  }

 private:
  std::unique_ptr<const Psf> psf_;
  Halo halo_;
};

}  // namespace

double Halo::scale_px() const { return radius_px / std::numbers::sqrt3; }

double Halo::mtf(double cycles_px) const {
  return std::exp(-2.0 * std::numbers::pi * scale_px() * std::abs(cycles_px));
}

std::unique_ptr<Psf> with_halo(std::unique_ptr<const Psf> psf, const Halo& halo) {
  if (!(halo.share >= 0.0) || !(halo.share < 1.0) || !(halo.radius_px > 0.0))
    throw InputError(format(
        "a halo of {:.4g} of the light within {:.4g} px; expected a share of 0 to less than 1, and more "
        "than 0 px",
        halo.share, halo.radius_px));
  return std::make_unique<HaloPsf>(std::move(psf), halo);
}

}  // namespace ifov::sensor
