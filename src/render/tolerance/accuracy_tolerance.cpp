#include "render/tolerance/accuracy_tolerance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "render/tolerance/channel_brightness.h"
#include "render/tolerance/degree_limits.h"
#include "render/tolerance/node_budget.h"
#include "sampling/intervals/bounded_error.h"

namespace ifov::render {
namespace {

/// Share of a pixel's radiance below which no error is resolved: paths and products are in single precision,
/// whose rounding errors are 1e-7 and, over a path, some 1e-6.
constexpr double kResolution = 1e-5;
/// What a white surface must send through the air, over what the air sends itself, for reflectance to mean anything.
constexpr double kSeen = 0.01;

}  // namespace

AccuracyTolerance::AccuracyTolerance(AccuracyRequest request, const ChannelBrightness& brightness,
                                     std::vector<double> white_reflected_w_m2_sr_um, std::int64_t pixel_count,
                                     const std::vector<double>& path_radiance_w_m2_sr_um,
                                     std::vector<AtmosphereHalfWidth> air)
    : request_(std::move(request)),
      brightness_(brightness),
      white_(std::move(white_reflected_w_m2_sr_um)),
      air_(std::move(air)) {
  const std::size_t channels = white_.size();
  judged_.assign(channels, request_.channels.empty() ? 1 : 0);
  for (int c : request_.channels) judged_[static_cast<std::size_t>(c)] = 1;
  if (request_.unit == ErrorUnit::reflectance && !path_radiance_w_m2_sr_um.empty())
    leave_hidden_channels(path_radiance_w_m2_sr_um);
  floor_.resize(channels);
  constexpr double kReference_k = 288.15;
  for (std::size_t c = 0; c < channels; ++c)
    floor_[c] =
        request_.floor * (white_[c] + brightness_.radiance_w_m2_sr_um(static_cast<int>(c), kReference_k));

  confidence_ = request_.confidence;
  if (request_.simultaneous) {
    const double statements =
        static_cast<double>(std::count(judged_.begin(), judged_.end(), 1)) * static_cast<double>(pixel_count);
    confidence_ = std::pow(request_.confidence, 1.0 / statements);  // Sidak 1967
  }
  joint_ = std::make_shared<const sampling::BoundedError>(confidence_);
  most_bounded_ = joint_->bound(1.0, kLeastShare);
}

void AccuracyTolerance::leave_room(std::vector<NodeHalfWidth> nodes, double cut_share) {
  nodes_ = std::move(nodes);
  cut_share_ = cut_share;
}

void AccuracyTolerance::judge_stokes(bool stokes, std::vector<double> passed) {
  stokes_ = stokes;
  passed_ = std::move(passed);
}

std::size_t AccuracyTolerance::judged_columns(std::size_t columns) const {
  return std::min(columns, stokes_ ? 4 * white_.size() : white_.size());
}

void AccuracyTolerance::ask_degree(std::size_t channel, std::span<const double> mean,
                                   std::span<double> limit) const {
  const std::size_t channels = white_.size();
  const bool told = stokes_ && mean.size() >= 4 * channels;
  const double passed = passed_.empty() ? 1.0 : passed_[channel];
  const double radiance = std::max(std::abs(mean[channel]), passed * floor_[channel]);
  const double degree =
      told ? std::hypot(mean[channels + channel], mean[2 * channels + channel]) / radiance : 0.0;
  const DegreeLimits asked = degree_limits(degree, request_.error);
  limit[channel] = std::max(asked.i, kResolution) * radiance;
  if (!told) return;
  limit[channels + channel] = limit[2 * channels + channel] = std::max(asked.qu, kResolution) * radiance;
  limit[3 * channels + channel] = std::numeric_limits<double>::infinity();
}

void AccuracyTolerance::leave_hidden_channels(const std::vector<double>& path_radiance) {
  std::vector<char> seen = judged_;
  for (std::size_t c = 0; c < seen.size(); ++c)
    if (white_[c] < kSeen * path_radiance[c]) seen[c] = 0;
  if (std::find(seen.begin(), seen.end(), 1) != seen.end()) judged_ = std::move(seen);
}

bool AccuracyTolerance::by_material() const {
  return std::any_of(nodes_.begin(), nodes_.end(),
                     [](const NodeHalfWidth& node) { return !node.emitted_of.empty(); });
}

void AccuracyTolerance::limits_holding(const sampling::Abundance* held, std::size_t count,
                                       std::span<const double> mean, std::span<double> limit) const {
  limits_beside({}, mean, limit, held, count);
}

void AccuracyTolerance::limits_beside(std::span<const double> bounds, std::span<const double> mean,
                                      std::span<double> limit, const sampling::Abundance* held,
                                      std::size_t count) const {
  asked(mean, limit);
  for (std::size_t c = 0; c < judged_columns(limit.size()); ++c) {
    if (std::isinf(limit[c])) continue;  // not judged
    const std::size_t channel = c % white_.size();
    double other = cut_share_ * limit[c], of_air = 0.0;
    if (!air_.empty())
      of_air = c == channel ? air_[c].all_of(mean[c]) : air_[channel].of_polarization(mean[channel]);
    other += of_air;
    if (!bounds.empty()) other += bounds[c];
    if (!nodes_.empty()) {
      const NodeHalfWidth& node = nodes_[channel];
      other += node.counted(std::abs(mean[channel]), limit[c],
                            std::max(node.given_up, node.emitted - emitted_by(node, held, count)));
    }
    const double of_rays = of_air > limit[c] ? kShareOfAir * of_air : 0.0;
    if (other > 0.0) limit[c] = std::max({joint_->random(limit[c], other), kLeastShare * limit[c], of_rays});
  }
}

double AccuracyTolerance::atmosphere_share(std::size_t channel, double radiance) const {
  std::vector<double> mean(white_.size(), 0.0), limit(white_.size());
  mean[channel] = radiance;
  asked(mean, limit);
  return air_.empty() ? 0.0 : air_[channel].all_of(radiance) / limit[channel];
}

void AccuracyTolerance::asked(std::span<const double> mean, std::span<double> limit) const {
  for (std::size_t c = 0; c < mean.size(); ++c) {
    if (c >= judged_.size() || !judged_[c]) {
      limit[c] = std::numeric_limits<double>::infinity();
      continue;
    }
    const double radiance = std::abs(mean[c]);
    const double passed = passed_.empty() ? 1.0 : passed_[c];
    switch (request_.unit) {
      case ErrorUnit::kelvin:
        limit[c] =
            request_.error * passed *
            brightness_.slope_w_m2_sr_um_k(static_cast<int>(c), std::max(radiance / passed, floor_[c]));
        break;
      case ErrorUnit::percent: limit[c] = std::max(request_.error * radiance, passed * floor_[c]); break;
      case ErrorUnit::radiance: limit[c] = request_.error; break;
      case ErrorUnit::reflectance: limit[c] = request_.error * passed * white_[c]; break;
      case ErrorUnit::noise: limit[c] = request_.error * request_.noise_w_m2_sr_um[c]; break;
      case ErrorUnit::polarization: limit[c] = 0.0; break;  // ask_degree(), below
    }
    limit[c] = std::max(limit[c], kResolution * radiance);
  }
  if (request_.unit == ErrorUnit::polarization) {
    for (std::size_t c = 0; c < std::min(white_.size(), mean.size()); ++c)
      if (judged_[c]) ask_degree(c, mean, limit);
  } else if (stokes_) {
    for (std::size_t c = white_.size(); c < judged_columns(mean.size()); ++c)
      limit[c] = limit[c % white_.size()];
  }
}

const sampling::BoundedError& joint_of(const AccuracyTolerance* tolerance) {
  static const sampling::BoundedError usual(0.95);
  return tolerance != nullptr ? tolerance->joint() : usual;
}

}  // namespace ifov::render
