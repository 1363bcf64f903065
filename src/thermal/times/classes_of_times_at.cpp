#include <algorithm>
#include <array>

#include "thermal/times/classes_of_times.h"
#include "thermal/times/node_of_times.h"

namespace ifov::thermal {
namespace {

constexpr double kLeastLeftOf = 0.01;  // as of SurfaceClasses::bends

}  // namespace

void ClassesOfTimes::at(const Pose& pose, double free_sky, At& at) const {
  const std::size_t lanes = lanes_;
  at.of_ = this;
  at.normal_ = pose.normal;
  at.corners_.clear();
  at.shaded_k.assign(lanes, 0.0f);
  at.of_sky_k.assign(lanes, 0.0f);
  at.weight_k.assign(bins() * lanes, 0.0f);
  const SurfaceClasses::Corners corners = classes_.front()->corners(pose);
  for (std::vector<float>* of : {&at.hidden_, &at.free_, &at.bent_}) of->resize(corners.count * lanes);
  const auto free = static_cast<float>(free_sky);
  for (const SurfaceClasses::Corners::Corner& corner : corners) {
    const NodeOfTimes& node = node_at(corner.place);
    const std::size_t c = at.corners_.size() * lanes;
    const auto share = static_cast<float>(corner.share);
    at.corners_.push_back({&node, share});
    for (std::size_t t = 0; t < lanes; ++t) {
      const float hidden_k = node.shaded_k[0][t], open_k = node.shaded_k[1][t];
      at.shaded_k[t] += share * (hidden_k + free * (open_k - hidden_k));
      at.of_sky_k[t] += share * (open_k - hidden_k);
      const float ratio = share * (node.ratio[0][t] + free * (node.ratio[1][t] - node.ratio[0][t]));
      at.hidden_[c + t] = ratio * (1.0f - free);
      at.free_[c + t] = ratio * free;
      at.bent_[c + t] = share * (1.0f + node.twice_shift[t]);
    }
  }
  for (std::size_t b = 0; b < bins(); ++b) {
    float* __restrict weight = at.weight_k.data() + b * lanes;
    std::size_t above = 0, below = 0;
    const Bin& bin = bins_[b];
    for (const math::Vec3& sun : bin.suns) ++(math::dot(pose.normal, sun) > 0.0 ? above : below);
    if (above == 0) continue;
    if (below == 0) {
      const std::array<float, 3> n{static_cast<float>(pose.normal.x), static_cast<float>(pose.normal.y),
                                   static_cast<float>(pose.normal.z)};
      for (std::size_t k = 0; k < at.corners_.size(); ++k) {
        const float* __restrict hidden = at.hidden_.data() + k * lanes, * __restrict open =
                                                                            at.free_.data() + k * lanes;
        const float* __restrict one = at.corners_[k].node->moment[0].data() + 3 * b * lanes;
        const float* __restrict other = at.corners_[k].node->moment[1].data() + 3 * b * lanes;
        for (std::size_t t = 0; t < lanes; ++t)
          weight[t] += hidden[t] * (n[0] * one[t] + n[1] * one[lanes + t] + n[2] * one[2 * lanes + t]) +
                       open[t] * (n[0] * other[t] + n[1] * other[lanes + t] + n[2] * other[2 * lanes + t]);
      }
    } else {
      for (std::uint32_t e = bin.first; e < bin.end; ++e)
        for (const bool right : {false, true}) {
          const std::size_t row = right ? spans_[e].right : spans_[e].left;
          at.add_row(row, math::dot(pose.normal, sun_[row]), right, 0.5, weight);
        }
    }
    for (std::size_t t = 0; t < lanes; ++t) weight[t] = std::max(weight[t], 0.0f);
  }
}

void ClassesOfTimes::At::add_row(std::size_t row, double cosine, bool right, double by, float* to) const {
  if (!(cosine > 0.0)) return;
  float* __restrict kelvin = to;
  const std::size_t lanes = of_->lanes_;
  const auto scale = static_cast<float>(cosine * by);
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const NodeOfTimes& node = *corners_[k].node;
    const float* __restrict hidden = hidden_.data() + k * lanes, * __restrict open = free_.data() + k * lanes;
    const auto& gains = right ? node.right : node.left;
    const float* __restrict one = gains[0].data() + row * lanes, * __restrict other =
                                                                     gains[1].data() + row * lanes;
    for (std::size_t t = 0; t < lanes; ++t) kelvin[t] += scale * (hidden[t] * one[t] + open[t] * other[t]);
  }
}

void ClassesOfTimes::At::weigh(const Moment& moment, std::span<float> kelvin) const {
  const Span& span = of_->spans_[moment.span];
  const double after = static_cast<double>(moment.within);
  std::fill(kelvin.begin(), kelvin.end(), 0.0f);
  add_row(span.left, math::dot(normal_, of_->sun_[span.left]), false, (1.0 - after) / span.density,
          kelvin.data());
  add_row(span.right, math::dot(normal_, of_->sun_[span.right]), true, after / span.density, kelvin.data());
}

void ClassesOfTimes::At::bends(std::span<float> per_pair) const {
  const std::size_t lanes = of_->lanes_, bins = of_->bins();
  static thread_local std::vector<float> until, scratch;
  until.assign(weight_k.begin(), weight_k.end());
  for (std::size_t at = lanes; at < bins * lanes; ++at) until[at] += until[at - lanes];
  scratch.assign(4 * lanes, 0.0f);
  float* __restrict kernel = scratch.data();
  float* __restrict bent = kernel + lanes, * __restrict last = bent + lanes, * __restrict sum = last + lanes;
  const float* __restrict all = until.data() + (bins - 1) * lanes;
  for (std::size_t b = bins; b-- > 0;) {
    std::fill_n(kernel, 2 * lanes, 0.0f);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const NodeOfTimes& node = *corners_[k].node;
      const float half = 0.5f * corners_[k].share;
      const float *__restrict one = node.sum[0].data() + b * lanes, *__restrict other = node.sum[1].data() + b * lanes,
                  *__restrict difference = node.difference.data() + b * lanes,
                  *__restrict by = bent_.data() + k * lanes;
      for (std::size_t t = 0; t < lanes; ++t) {
        kernel[t] += half * (one[t] + other[t]);
        bent[t] += by[t] * difference[t];
      }
    }
    const float* __restrict here = until.data() + b * lanes;
    float* __restrict told = per_pair.data() + b * lanes;
    for (std::size_t t = 0; t < lanes; ++t) {
      constexpr float kSmall = 1e-30f;  // of a kernel, in place of 0
      const float found = std::min(1.0f, std::max(-1.0f, bent[t] / std::max(kernel[t], kSmall)));
      const float bend = kernel[t] > 0.0f ? found : last[t];
      const float more = (bend - last[t]) / std::max(here[t], kSmall);
      sum[t] += here[t] > static_cast<float>(kLeastLeftOf) * all[t] ? more : 0.0f;
      last[t] = bend;
      told[t] = sum[t];
    }
  }
}

}  // namespace ifov::thermal
