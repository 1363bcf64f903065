#include "render/mirrors/focal_lights.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sampling/footprint_groups.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/tile.h"
#include "sampling/tolerance.h"

namespace ifov::render {

namespace {

struct Replicated {
  double mean, variance;  // of the mean
};

/// Of replicates that stand so far apart.
Replicated replicated(const double* sums, std::size_t stride) {
  double mean = 0.0, squares = 0.0;
  for (std::size_t r = 0; r < FocalLights::kReplicates; ++r) mean += sums[r * stride];
  mean /= FocalLights::kReplicates;
  for (std::size_t r = 0; r < FocalLights::kReplicates; ++r) {
    const double off = sums[r * stride] - mean;
    squares += off * off;
  }
  return {mean, squares / (FocalLights::kReplicates * (FocalLights::kReplicates - 1.0))};
}

}  // namespace

std::uint32_t FocalLights::add_spectrum(std::span<const float> channels) {
  const auto spectrum = static_cast<std::uint32_t>(spectra_.size() / channels_);
  spectra_.insert(spectra_.end(), channels.begin(),
                  channels.begin() + static_cast<std::ptrdiff_t>(channels_));
  return spectrum;
}

void FocalLights::append(const FocalLights& other) {
  const auto first = static_cast<std::uint32_t>(spectra_.size() / channels_);
  spectra_.insert(spectra_.end(), other.spectra_.begin(), other.spectra_.end());
  for (Light light : other.lights_) {
    light.spectrum += first;
    lights_.push_back(light);
  }
}

void FocalLights::sort() {
  std::stable_sort(lights_.begin(), lights_.end(),
                   [](const Light& a, const Light& b) { return a.at.y_px < b.at.y_px; });
}

std::vector<FocalLights::Distant> FocalLights::distant() const {
  const auto cell_of = [](const sampling::FocalPoint& at, double side_px) {
    return std::pair{static_cast<std::int64_t>(std::floor(at.y_px / side_px)),
                     static_cast<std::int64_t>(std::floor(at.x_px / side_px))};
  };
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<const Light*>> cells;
  for (double side_px = kDistantCell_px;; side_px *= 2.0) {
    cells.clear();
    for (const Light& light : lights_) cells[cell_of(light.at, side_px)].push_back(&light);
    if (cells.size() <= kMostDistant) break;
  }
  std::vector<Distant> all;
  std::vector<double> sums(kReplicates * channels_);
  for (const auto& [cell, lights] : cells) {
    std::fill(sums.begin(), sums.end(), 0.0);
    double x = 0.0, y = 0.0, weights = 0.0;
    for (const Light* light : lights) {
      const float* const spectrum = spectra_.data() + light->spectrum * channels_;
      double bright = 0.0;
      for (std::size_t c = 0; c < channels_; ++c) {
        const double part = static_cast<double>(light->per_radiance) * static_cast<double>(spectrum[c]);
        sums[light->replicate * channels_ + c] += part;
        bright += std::abs(part);
      }
      weights += bright;
      x += bright * light->at.x_px;
      y += bright * light->at.y_px;
    }
    if (!(weights > 0.0)) continue;
    Distant& one = all.emplace_back();
    one.middle = {x / weights, y / weights};
    for (std::size_t c = 0; c < channels_; ++c) {
      const Replicated mean = replicated(sums.data() + c, channels_);
      one.light.push_back(static_cast<float>(mean.mean));
      one.variance.push_back(static_cast<float>(mean.variance));
    }
  }
  return all;
}

void FocalLights::add_to(const sampling::ColumnFootprints& footprints, const sampling::Tolerance* tolerance,
                         sampling::TileResult& tile, std::span<const double> kept) const {
  if (lights_.empty()) return;
  const double reach = footprints.half_width_px();
  std::vector<double> weights(footprints.groups());
  const int width = tile.tile.width();
  std::vector<std::vector<double>> sums(static_cast<std::size_t>(tile.tile.count()));  // [replicate][channel]
  auto light = std::lower_bound(lights_.begin(), lights_.end(), tile.tile.y0 - reach - 1.0,
                                [](const Light& a, double y) { return a.at.y_px < y; });
  for (; light != lights_.end() && light->at.y_px < tile.tile.y1 + reach + 1.0; ++light) {
    // Pixels whose centres are within reach, each border to one of its sides.
    const auto range = [&](double at, int low, int high) {
      return std::pair{std::max(low, static_cast<int>(std::floor(at - 0.5 - reach)) + 1),
                       std::min(high - 1, static_cast<int>(std::floor(at - 0.5 + reach)))};
    };
    const auto [x0, x1] = range(light->at.x_px, tile.tile.x0, tile.tile.x1);
    const auto [y0, y1] = range(light->at.y_px, tile.tile.y0, tile.tile.y1);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        bool any = false;
        for (std::size_t group = 0; group < weights.size(); ++group) {
          weights[group] = footprints.density(group, x, light->at.x_px - x - 0.5, light->at.y_px - y - 0.5) *
                           static_cast<double>(light->per_radiance) * (kept.empty() ? 1.0 : kept[group]);
          any = any || weights[group] > 0.0;
        }
        if (!any) continue;
        auto& sum = sums[static_cast<std::size_t>((y - tile.tile.y0) * width + x - tile.tile.x0)];
        if (sum.empty()) sum.assign(kReplicates * channels_, 0.0);
        for (std::size_t c = 0; c < channels_; ++c)
          sum[light->replicate * channels_ + c] +=
              weights[footprints.group_of(c)] *
              static_cast<double>(spectra_[light->spectrum * channels_ + c]);
      }
  }
  std::vector<double> mean(channels_), limit(channels_);
  for (std::size_t pixel = 0; pixel < sums.size(); ++pixel) {
    if (sums[pixel].empty()) continue;
    double worst = 0.0;
    for (std::size_t c = 0; c < channels_; ++c) {
      const std::size_t at = pixel * channels_ + c;
      const auto [glint, variance] = replicated(sums[pixel].data() + c, channels_);
      mean[c] = static_cast<double>(tile.mean[at]) + glint;
      tile.mean[at] = static_cast<float>(mean[c]);
      if (!tile.has_errors()) continue;
      const double student = sampling::two_sided_student(
          tolerance != nullptr ? tolerance->confidence() : 0.95, kReplicates - 1.0);
      tile.variance_path[at] += static_cast<float>(variance);
      tile.half_width[at] = static_cast<float>(
          std::hypot(static_cast<double>(tile.half_width[at]), student * std::sqrt(variance)));
    }
    if (tolerance == nullptr || !tile.has_errors()) continue;
    tolerance->limits(mean, limit);
    for (std::size_t c = 0; c < channels_; ++c)
      worst = std::max(worst, static_cast<double>(tile.half_width[pixel * channels_ + c]) / limit[c]);
    tile.worst_ratio[pixel] = static_cast<float>(worst);
    tile.set(pixel, sampling::Reason::error, worst > 1.0 + 1e-6);
  }
}

}  // namespace ifov::render
