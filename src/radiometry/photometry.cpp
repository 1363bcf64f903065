#include "radiometry/photometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "math/angle.h"
#include "radiometry/embedded_table.h"
#include "radiometry/gauss_legendre.h"

namespace ifov::data {
extern const std::string_view luminous_efficiency_csv;
}

namespace ifov::radiometry {

const Spectrum& luminous_efficiency() {
  static const Spectrum spectrum =
      embedded_spectrum(data::luminous_efficiency_csv, OutsideRange::zero, "luminous efficiency");
  return spectrum;
}

double luminous(const Spectrum& per_um) {
  const Spectrum& eye = luminous_efficiency();
  const Spectrum seen = per_um.with_outside(OutsideRange::zero);
  const std::array<const Spectrum*, 2> factors{&eye, per_um.is_constant() ? &per_um : &seen};
  return kLuminousEfficacy_lm_w * integral_of_product(factors, eye.first_um(), eye.last_um());
}

LuminousIntensity::LuminousIntensity(std::vector<double> from_down_deg, std::vector<double> about_deg,
                                     std::vector<double> candela)
    : from_down_deg_(std::move(from_down_deg)),
      about_deg_(std::move(about_deg)),
      candela_(std::move(candela)) {
  const auto rises = [](const std::vector<double>& angles) {
    return std::adjacent_find(angles.begin(), angles.end(), [](double a, double b) { return !(a < b); }) ==
           angles.end();
  };
  if (from_down_deg_.size() < 2 || !rises(from_down_deg_) || from_down_deg_.front() < 0.0 ||
      from_down_deg_.back() > 180.0)
    throw InputError("vertical angles have to rise, from 0 or more to 180 deg or less");
  const double first = about_deg_.empty() ? -1.0 : about_deg_.front(),
               last = about_deg_.empty() ? -1.0 : about_deg_.back();
  const bool known = (about_deg_.size() == 1 && first == 0.0) ||
                     (first == 0.0 && (last == 90.0 || last == 180.0 || last == 360.0)) ||
                     (first == 90.0 && last == 270.0);
  if (!known || !rises(about_deg_))
    throw InputError(
        "horizontal angles have to rise: 0 alone, from 0 to 90, 180 or 360, or from 90 to 270 deg");
  if (candela_.size() != from_down_deg_.size() * about_deg_.size())
    throw InputError(format("{} intensities for {} x {} angles", candela_.size(), about_deg_.size(),
                            from_down_deg_.size()));
  for (const double value : candela_) {
    if (!(value >= 0.0)) throw InputError(format("an intensity of {:g} cd is below 0", value));
    highest_ = std::max(highest_, value);
  }
  if (!(highest_ > 0.0)) throw InputError("all intensities are 0");
}

double LuminousIntensity::in_plane(std::size_t plane, double angle_deg) const {
  if (angle_deg < from_down_deg_.front() || angle_deg > from_down_deg_.back()) return 0.0;
  const auto above = std::upper_bound(from_down_deg_.begin() + 1, from_down_deg_.end() - 1, angle_deg);
  const auto k = static_cast<std::size_t>(above - from_down_deg_.begin());
  const double share = (angle_deg - from_down_deg_[k - 1]) / (from_down_deg_[k] - from_down_deg_[k - 1]);
  const double* row = &candela_[plane * from_down_deg_.size()];
  return row[k - 1] + share * (row[k] - row[k - 1]);
}

double LuminousIntensity::at(double from_down_rad, double about_rad) const {
  const double down = std::min(180.0, from_down_rad / math::kDegree);
  if (about_deg_.size() == 1) return in_plane(0, down);
  const double first = about_deg_.front(), last = about_deg_.back();
  double about = about_rad / math::kDegree - 360.0 * std::floor(about_rad / math::kDegree / 360.0);
  if (first == 90.0) {
    if (about < 90.0) about = 180.0 - about;
    if (about > 270.0) about = 540.0 - about;
  } else {
    if (last < 360.0 && about > 180.0) about = 360.0 - about;
    if (last == 90.0 && about > 90.0) about = 180.0 - about;
  }
  about = std::clamp(about, first, last);
  const auto above = std::upper_bound(about_deg_.begin() + 1, about_deg_.end() - 1, about);
  const auto k = static_cast<std::size_t>(above - about_deg_.begin());
  const double share = (about - about_deg_[k - 1]) / (about_deg_[k] - about_deg_[k - 1]);
  const double before = in_plane(k - 1, down), after = in_plane(k, down);
  return before + share * (after - before);
}

double LuminousIntensity::flux_lm() const {
  // Piecewise linear: steps between the given angles, around at even ones.
  constexpr int kAround = 720, kParts = 8;
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < from_down_deg_.size(); ++k)
    for (int part = 0; part < kParts; ++part) {
      const double width = (from_down_deg_[k + 1] - from_down_deg_[k]) / kParts * math::kDegree;
      const double begin = from_down_deg_[k] * math::kDegree + part * width;
      for (const GaussPoint& gauss : kGauss2) {
        const double down = begin + gauss.position * width;
        double around = 0.0;
        for (int j = 0; j < kAround; ++j) around += at(down, (j + 0.5) * 360.0 / kAround * math::kDegree);
        sum += gauss.weight * width * std::sin(down) * around * 360.0 / kAround * math::kDegree;
      }
    }
  return sum;
}

}  // namespace ifov::radiometry
