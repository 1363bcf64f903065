#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "sensor/optics/psf_product.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

class CrosstalkPsf final : public Psf {
 public:
  CrosstalkPsf(std::unique_ptr<const Psf> psf, const Crosstalk& shares)
      : perfect_(psf == nullptr), psf_(std::move(psf)), shares_(shares) {
    // Edges of elements that step cannot be tabulated: they are this sharp, which takes 3e-4 of the modulation at 1/2 cycle a pixel.
    constexpr double kSharp_px = 1.0 / 128.0;
    if (perfect_) psf_ = make_gaussian_psf(kSharp_px);
  }

  double half_width_px() const override { return 1.0 + psf_->half_width_px(); }
  double detail_px() const override { return psf_->detail_px(); }
  double kept() const override { return perfect_ ? 1.0 : psf_->kept(); }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return over_neighbours(
        [&](double dx, double dy) { return psf_->energy(x0_px - dx, y0_px - dy, x1_px - dx, y1_px - dy); });
  }
  double cut_density(double dx_px, double dy_px, bool smooth) const override {
    if (perfect_) return 0.0;
    return over_neighbours(
        [&](double dx, double dy) { return psf_->cut_density(dx_px - dx, dy_px - dy, smooth); });
  }
  bool has_wings() const override { return psf_->has_wings(); }
  bool round() const override { return false; }
  bool mirrored() const override { return psf_->mirrored(); }
  std::string description() const override {
    return format("{}; neighbours get {:.3g} % of what falls on an element",
                  perfect_ ? "no blur" : psf_->description(), 100.0 * (1.0 - own()));
  }

 private:
  double own() const { return 1.0 - 2.0 * shares_.beside - 2.0 * shares_.above - 4.0 * shares_.corner; }

  template <class At>
  double over_neighbours(const At& at) const {
    double sum = own() * at(0.0, 0.0);
    if (shares_.beside > 0.0) sum += shares_.beside * (at(-1.0, 0.0) + at(1.0, 0.0));
    if (shares_.above > 0.0) sum += shares_.above * (at(0.0, -1.0) + at(0.0, 1.0));
    if (shares_.corner > 0.0)
      sum += shares_.corner * (at(-1.0, -1.0) + at(1.0, -1.0) + at(-1.0, 1.0) + at(1.0, 1.0));
    return sum;
  }

  bool perfect_;
  std::unique_ptr<const Psf> psf_;
  Crosstalk shares_;
};

}  // namespace

double Crosstalk::mtf(double cycles_px) const {
  return 1.0 - (2.0 * beside + 4.0 * corner) * (1.0 - std::cos(2.0 * std::numbers::pi * cycles_px));
}

std::unique_ptr<Psf> with_crosstalk(std::unique_ptr<const Psf> psf, const Crosstalk& crosstalk) {
  const double passed = 2.0 * crosstalk.beside + 2.0 * crosstalk.above + 4.0 * crosstalk.corner;
  if (!(crosstalk.beside >= 0.0) || !(crosstalk.above >= 0.0) || !(crosstalk.corner >= 0.0) ||
      !(passed < 1.0))
    throw InputError(format(
        "elements pass {:.4g} % of what falls on them to their neighbours; expected less than all of it",
        100.0 * passed));
  return std::make_unique<CrosstalkPsf>(std::move(psf), crosstalk);
}

}  // namespace ifov::sensor
