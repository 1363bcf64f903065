#include "sampling/pixel_accumulator.h"

#include <algorithm>
#include <limits>

namespace ifov::sampling {

void PixelAccumulator::clear() {
  used_ = last_ = 0;
  count_ = 0;
}

PixelAccumulator::Group& PixelAccumulator::group_of(Label label, std::uint32_t material,
                                                    const float* values) {
  if (last_ < used_ && groups_[last_].label == label) return groups_[last_];
  for (last_ = 0; last_ < used_; ++last_)
    if (groups_[last_].label == label) return groups_[last_];
  if (used_ == groups_.size()) groups_.emplace_back();
  Group& group = groups_[used_++];
  group.label = label;
  group.material = material;
  group.weight = group.weight_squared = 0.0;
  group.origin.assign(values, values + columns_);
  group.w_d.assign(columns_, 0.0);
  group.w2_d.assign(columns_, 0.0);
  group.w2_d2.assign(columns_, 0.0);
  return group;
}

void PixelAccumulator::add(double weight, Label label, std::uint32_t material, const float* values) {
  if (weight == 0.0) return;
  Group& group = group_of(label, material, values);
  group.weight += weight;
  group.weight_squared += weight * weight;
  ++count_;
  const float* origin = group.origin.data();
  double *a = group.w_d.data(), *b = group.w2_d.data(), *c = group.w2_d2.data();
  for (std::size_t k = 0; k < columns_; ++k) {
    const double d = static_cast<double>(values[k]) - static_cast<double>(origin[k]);
    const double wd = weight * d, w2d = weight * wd;
    a[k] += wd;
    b[k] += w2d;
    c[k] += w2d * d;
  }
}

PixelEstimate PixelAccumulator::estimate() const {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  PixelEstimate e;
  e.mean.assign(columns_, 0.0);
  e.variance_geometry.assign(columns_, count_ < 2 ? kUnknown : 0.0);
  e.variance_path = e.variance_geometry;
  for (std::size_t g = 0; g < used_; ++g)
    for (std::size_t k = 0; k < columns_; ++k)
      e.mean[k] += groups_[g].weight * static_cast<double>(groups_[g].origin[k]) + groups_[g].w_d[k];
  double weight_squared = 0.0;
  const double unbias = count_ < 2 ? kUnknown : count_ / (count_ - 1.0);
  for (std::size_t g = 0; g < used_; ++g) {
    const Group& group = groups_[g];
    weight_squared += group.weight_squared;
    for (std::size_t k = 0; k < columns_; ++k) {
      const double shift = group.w2_d[k] / group.weight_squared;
      const double apart = static_cast<double>(group.origin[k]) + shift - e.mean[k];
      // Under one label nothing lies between labels: the weights alone set the two means apart.
      (used_ > 1 ? e.variance_geometry : e.variance_path)[k] += unbias * group.weight_squared * apart * apart;
      e.variance_path[k] += unbias * std::max(0.0, group.w2_d2[k] - shift * group.w2_d[k]);
    }
  }
  for (std::size_t g = 0; g < used_; ++g) e.materials[groups_[g].material].fraction += groups_[g].weight;
  for (auto& [material, share] : e.materials)
    share.variance = unbias * weight_squared * std::max(0.0, share.fraction * (1.0 - share.fraction));
  return e;
}

}  // namespace ifov::sampling
