#include "render/mirrors/focal_lights.h"

#include <algorithm>
#include <cmath>

#include "sampling/footprint_groups.h"
#include "sampling/quantiles.h"
#include "sampling/tile.h"
#include "sampling/tolerance.h"

namespace ifov::render {

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

void FocalLights::add_to(const sampling::ColumnFootprints& footprints, const sampling::Tolerance* tolerance,
                         sampling::TileResult& tile) const {
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
          weights[group] = footprints.density(group, light->at.x_px - x - 0.5, light->at.y_px - y - 0.5) *
                           static_cast<double>(light->per_radiance);
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
      double sum = 0.0, squares = 0.0;
      for (std::size_t r = 0; r < kReplicates; ++r) sum += sums[pixel][r * channels_ + c];
      const double glint = sum / kReplicates;
      for (std::size_t r = 0; r < kReplicates; ++r) {
        const double off = sums[pixel][r * channels_ + c] - glint;
        squares += off * off;
      }
      mean[c] = static_cast<double>(tile.mean[at]) + glint;
      tile.mean[at] = static_cast<float>(mean[c]);
      if (!tile.has_errors()) continue;
      const double variance = squares / (kReplicates * (kReplicates - 1.0));
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
