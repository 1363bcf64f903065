#include <algorithm>
#include <cmath>
#include <utility>

#include "core/format.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

class StretchedPsf final : public Psf {
 public:
  StretchedPsf(std::unique_ptr<const Psf> psf, double along_x, double along_y)
      : psf_(std::move(psf)), along_x_(along_x), along_y_(along_y) {}

  double half_width_px() const override { return psf_->half_width_px() * std::max(along_x_, along_y_); }
  double detail_px() const override { return psf_->detail_px() * std::min(along_x_, along_y_); }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return psf_->energy(x0_px / along_x_, y0_px / along_y_, x1_px / along_x_, y1_px / along_y_);
  }
  double kept() const override { return psf_->kept(); }
  double cut_density(double dx_px, double dy_px, bool smooth) const override {
    return psf_->cut_density(dx_px / along_x_, dy_px / along_y_, smooth) / (along_x_ * along_y_);
  }
  bool has_wings() const override { return psf_->has_wings(); }
  bool round() const override { return false; }
  bool separable() const override { return psf_->separable(); }
  bool mirrored() const override { return psf_->mirrored(); }
  std::string description() const override {
    return format("{}; {:.3g} samples by {:.3g} lines of the image are a pixel of it", psf_->description(),
                  along_x_, along_y_);
  }

 private:
  std::unique_ptr<const Psf> psf_;
  double along_x_, along_y_;
};

}  // namespace

std::unique_ptr<const Psf> stretched_psf(std::unique_ptr<const Psf> psf, double along_x, double along_y) {
  // Less is within what channels of one footprint may be apart by.
  constexpr double kSame = 1e-3;
  if (psf == nullptr || (std::abs(along_x - 1.0) < kSame && std::abs(along_y - 1.0) < kSame)) return psf;
  return std::make_unique<StretchedPsf>(std::move(psf), along_x, along_y);
}

}  // namespace ifov::sensor
