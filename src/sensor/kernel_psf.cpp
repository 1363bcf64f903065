#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sensor/energy_table.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

class KernelPsf final : public Psf {
 public:
  KernelPsf(int columns, int rows, const std::vector<double>& values, double samples_per_pixel)
      : columns_(columns),
        rows_(rows),
        sample_px_(1.0 / samples_per_pixel),
        table_(columns, rows, sample_px_, values) {}

  double half_width_px() const override { return table_.half_width_px(); }
  double detail_px() const override { return 2.0 * sample_px_; }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return table_.within(x0_px, y0_px, x1_px, y1_px);
  }
  double kept() const override { return 1.0; }  // what lies beyond its rim nobody has measured
  double cut_density(double, double, bool) const override { return 0.0; }
  std::string description() const override {
    return format("kernel of {} x {} samples of {:g} px", columns_, rows_, sample_px_);
  }

 private:
  int columns_, rows_;
  double sample_px_;
  EnergyTable table_;
};

}  // namespace

std::unique_ptr<Psf> make_kernel_psf(int columns, int rows, std::vector<double> values,
                                     double samples_per_pixel) {
  if (columns < 1 || rows < 1 ||
      values.size() != static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
    throw InputError(format("a PSF kernel of {} x {} samples has {} values", columns, rows, values.size()));
  if (!(samples_per_pixel > 0.0) || !std::isfinite(samples_per_pixel))
    throw InputError(
        format("a PSF kernel with {} samples per pixel; expected a positive number", samples_per_pixel));
  for (const double value : values)
    if (!(value >= 0.0) || !std::isfinite(value))
      throw InputError(format("a PSF kernel with the value {}; expected finite values of at least 0", value));
  // A pixel looks the other way than light goes: its response is the image of a point turned by 180 deg.
  std::reverse(values.begin(), values.end());
  return std::make_unique<KernelPsf>(columns, rows, values, samples_per_pixel);
}

}  // namespace ifov::sensor
