#include "honesty/interval_statistics.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace ifov::benchmarks {

IntervalStatistics::IntervalStatistics(std::vector<PixelIndex> pixels, PlainMeans reference)
    : pixels_(std::move(pixels)),
      reference_(std::move(reference)),
      sums_(static_cast<std::size_t>(reference_.columns)) {}

void IntervalStatistics::add(const sampling::TileResult& result) {
  const auto columns = static_cast<std::size_t>(result.columns);
  std::vector<double> image_error(columns, 0.0);
  for (std::size_t p = 0; p < pixels_.size(); ++p) {
    const auto pixel = static_cast<std::size_t>((pixels_[p].y - result.tile.y0) * result.tile.width() +
                                                (pixels_[p].x - result.tile.x0));
    for (std::size_t c = 0; c < columns; ++c) {
      Sums& sums = sums_[c];
      const std::size_t k = pixel * columns + c;
      const double error = static_cast<double>(result.mean[k]) - reference_.mean[p * columns + c];
      const double reference_error = reference_.standard_error[p * columns + c];
      // Q, U and V of what depolarizes are 0 on every path: any interval holds that.
      if (reference_.mean[p * columns + c] == 0.0 && reference_error == 0.0 && result.mean[k] == 0.0f) {
        ++sums.zeros;
        continue;
      }
      const double half_width = static_cast<double>(result.half_width[k]);
      const double geometry = static_cast<double>(result.variance_geometry[k]);
      const double path = static_cast<double>(result.variance_path[k]);
      const double sigma = std::sqrt(geometry + path + reference_error * reference_error);
      const bool covered = std::abs(error) <= half_width;
      ++sums.count;
      sums.covered += covered;
      sums.beyond_four += std::abs(error) > 4.0 * sigma;
      // A feature of fraction a changes the mean by at most a times the contrast, for which the spread
      // stands.
      const double missable =
          static_cast<double>(result.missable_fraction[pixel]) * 2.0 * reference_.spread[p * columns + c];
      sums.small_misses += !covered && std::abs(error) <= half_width + missable;
      sums.half_width += half_width;
      sums.squared_error += error * error;
      sums.reference_variance += reference_error * reference_error;
      sums.geometry += geometry;
      sums.path += path;
      image_error[c] += error / static_cast<double>(pixels_.size());
    }
  }
  for (std::size_t c = 0; c < columns; ++c) sums_[c].image_error.push_back(image_error[c]);
}

std::vector<ChannelHonesty> IntervalStatistics::summary() const {
  std::vector<ChannelHonesty> channels;
  for (const Sums& sums : sums_) {
    // Of a scene all of whose light is 0, all intervals hold it.
    if (sums.count == 0) {
      channels.push_back({.count = sums.zeros, .coverage = 0.95});
      continue;
    }
    const auto n = static_cast<double>(sums.count), seeds = static_cast<double>(sums.image_error.size());
    ChannelHonesty channel;
    channel.count = sums.count;
    channel.coverage = static_cast<double>(sums.covered) / n;
    channel.beyond_four = static_cast<double>(sums.beyond_four) / n;
    channel.mean_half_width = sums.half_width / n;
    channel.rms_error = std::sqrt(std::max(0.0, (sums.squared_error - sums.reference_variance) / n));
    channel.half_width_to_rms = channel.mean_half_width / channel.rms_error;
    channel.geometric_sigma = std::sqrt(sums.geometry / n);
    channel.path_sigma = std::sqrt(sums.path / n);
    channel.reference_to_half_width = std::sqrt(sums.reference_variance / n) / channel.mean_half_width;
    channel.small_misses = sums.small_misses;

    double mean = 0.0, squares = 0.0;
    for (const double error : sums.image_error) mean += error / seeds;
    for (const double error : sums.image_error) squares += (error - mean) * (error - mean);
    // The same reference serves every seed: its error does not average out over seeds, only over pixels.
    const double reference_variance = sums.reference_variance / n / static_cast<double>(pixels_.size());
    channel.bias = mean / std::sqrt(squares / (seeds - 1.0) / seeds + reference_variance);
    channels.push_back(channel);
  }
  return channels;
}

std::string ChannelHonesty::fault() const {
  std::string text;
  const auto require = [&text](bool kept, const std::string& what) {
    if (!kept) text += (text.empty() ? "" : "; ") + what;
  };
  require(coverage >= 0.93 && coverage <= 0.995, format("coverage {:.4f} outside 0.93 to 0.995", coverage));
  require(beyond_four < 0.002, format("|z| > 4 in {:.2f} %", 100.0 * beyond_four));
  require(half_width_to_rms <= 3.0, format("half-width {:.2f} times the RMS error", half_width_to_rms));
  require(std::abs(bias) <= 4.0, format("bias of {:.1f} standard errors", bias));
  require(reference_to_half_width <= 0.2,
          format("reference error {:.2f} of the half-width", reference_to_half_width));
  return text;
}

}  // namespace ifov::benchmarks
