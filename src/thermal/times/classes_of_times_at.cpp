#include <algorithm>
#include <array>

#include "thermal/times/classes_of_times.h"
#include "thermal/times/direction_of_times.h"

namespace ifov::thermal {
namespace {

constexpr float kLeastLeftOf = 0.01f;  // as of SurfaceClasses::bends

}  // namespace

void ClassesOfTimes::at(const Pose& pose, double free_sky, At& at) const {
  const std::size_t lanes = lanes_;
  at.of_ = this;
  at.normal_ = pose.normal;
  at.count_ = 0;
  const auto free = static_cast<float>(free_sky);
  at.by_sky_ = {(1.0f - free) * (1.0f - free), free * (1.0f - free), free * free};
  const SurfaceClasses::AboveLevel above = classes_.front()->level_of(pose.height_m);
  for (const auto& [level, share] :
       {std::pair{above.level, 1.0 - above.stronger}, std::pair{above.level + 1, above.stronger}})
    if (share > 0.0) at.levels_[at.count_++] = {&direction(pose.normal, level), static_cast<float>(share)};
  at.shaded_k.assign(lanes, 0.0f);
  at.of_sky_k.assign(lanes, 0.0f);
  at.all_k.assign(lanes, 0.0f);
  for (std::size_t k = 0; k < at.count_; ++k) {
    const auto& [direction, share] = at.levels_[k];
    for (std::size_t t = 0; t < lanes; ++t) {
      at.shaded_k[t] += share * (direction->shaded_k[t] + free * direction->of_sky_k[t]);
      at.of_sky_k[t] += share * direction->of_sky_k[t];
    }
    at.add(direction->all.data(), share, 0, at.all_k.data());
  }
}

void ClassesOfTimes::At::add(const float* rows, float scale, std::size_t first_lane, float* to) const {
  const std::size_t lanes = of_->lanes_;
  const float* __restrict hidden = rows;
  float* __restrict sum = to;
  const float both = scale * by_sky_[0], half = scale * by_sky_[1], none = scale * by_sky_[2];
  for (std::size_t t = first_lane; t < lanes; ++t)
    sum[t] += both * hidden[t] + half * hidden[lanes + t] + none * hidden[2 * lanes + t];
}

void ClassesOfTimes::At::weights(std::span<float> kelvin) const {
  const std::size_t lanes = of_->lanes_;
  std::fill(kelvin.begin(), kelvin.end(), 0.0f);
  for (std::size_t k = 0; k < count_; ++k)
    for (std::size_t b = 0; b < of_->bins(); ++b)
      add(levels_[k].direction->weight.data() + 3 * b * lanes, levels_[k].share, first_lane(b),
          kelvin.data() + b * lanes);
}

void ClassesOfTimes::At::add_row(std::size_t row, double cosine, bool right, double by,
                                 std::size_t first_lane, float* kelvin) const {
  if (!(cosine > 0.0)) return;
  for (std::size_t k = 0; k < count_; ++k)
    add(of_->combined_row(*levels_[k].direction, row, right),
        static_cast<float>(cosine * by) * levels_[k].share, first_lane, kelvin);
}

void ClassesOfTimes::At::weigh(const Moment& moment, std::span<float> kelvin) const {
  const Span& span = of_->spans_[moment.span];
  const double after = static_cast<double>(moment.within);
  std::fill(kelvin.begin(), kelvin.end(), 0.0f);
  add_row(span.left, of_->of_time(0).facing(normal_, of_->sun_[span.left]), false,
          (1.0 - after) / span.density, span.first_lane, kelvin.data());
  add_row(span.right, of_->of_time(0).facing(normal_, of_->sun_[span.right]), true, after / span.density,
          span.first_lane, kelvin.data());
}

void ClassesOfTimes::At::bends(std::span<const float> weight_k, std::span<float> per_pair) const {
  const std::size_t lanes = of_->lanes_, bins = of_->bins();
  static thread_local std::vector<float> scratch;
  scratch.assign(6 * lanes, 0.0f);
  float* __restrict kernel = scratch.data();
  float* __restrict bent = kernel + lanes, * __restrict last = bent + lanes, * __restrict sum = last + lanes, * __restrict here = sum + lanes, * __restrict all = here + lanes;
  for (std::size_t b = 0; b < bins; ++b)
    for (std::size_t t = first_lane(b); t < lanes; ++t) all[t] += weight_k[b * lanes + t];
  for (std::size_t t = 0; t < lanes; ++t) here[t] = all[t];
  for (std::size_t k = 0; k < count_; ++k)
    if (levels_[k].direction->kernel.empty()) of_->combine_bends(*levels_[k].direction);
  for (std::size_t b = bins; b-- > 0;) {
    const std::size_t first = first_lane(b);
    const float *of_one = levels_[0].direction->bend.data() + b * lanes,
                *kernel_of_one = levels_[0].direction->kernel.data() + b * lanes;
    if (count_ > 1) std::fill_n(kernel, 2 * lanes, 0.0f), of_one = bent, kernel_of_one = kernel;
    for (std::size_t k = 0; count_ > 1 && k < count_; ++k) {
      const float share = levels_[k].share;
      const float* __restrict of_kernel = levels_[k].direction->kernel.data() + b * lanes;
      const float* __restrict of_bent = levels_[k].direction->bent.data() + b * lanes;
      for (std::size_t t = first; t < lanes; ++t) {
        kernel[t] += share * of_kernel[t];
        bent[t] += share * of_bent[t];
      }
    }
    if (count_ > 1)
      for (std::size_t t = first; t < lanes; ++t) bent[t] = bend_of(bent[t], kernel[t]);
    const float* __restrict weight = weight_k.data() + b * lanes;
    float* __restrict told = per_pair.data() + b * lanes;
    for (std::size_t t = first; t < lanes; ++t) {
      constexpr float kSmall = 1e-30f;  // of a kernel, in place of 0
      const float bend = kernel_of_one[t] > 0.0f ? of_one[t] : last[t];
      const float more = (bend - last[t]) / std::max(here[t], kSmall);
      sum[t] += here[t] > kLeastLeftOf * all[t] ? more : 0.0f;
      last[t] = bend;
      told[t] = sum[t];
      here[t] -= weight[t];
    }
  }
}

}  // namespace ifov::thermal
