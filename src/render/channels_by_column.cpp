#include "render/channels_by_column.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/parts/part_columns.h"
#include "render/polarized/stokes_columns.h"
#include "render/tolerance/node_budget.h"
#include "render/truth_layers.h"
#include "sampling/tile.h"
#include "sensor/spectrometer/column_responses.h"

namespace ifov::render {
namespace {

enum class As { mean, spread, variance };

/// Rows of values by what is carried, several components one behind the other, as rows by channel.
class Mixing {
 public:
  Mixing(const sensor::ColumnResponses& responses, const sampling::PixelRect& tile)
      : responses_(responses), tile_(tile), pixels_(static_cast<std::size_t>(tile.count())) {}

  std::vector<float> operator()(std::span<const float> values, As as) const {
    const std::size_t carried = responses_.carried(), channels = responses_.channels();
    if (values.empty() || pixels_ == 0) return {};
    const std::size_t components = values.size() / (pixels_ * carried);
    std::vector<float> made;
    made.reserve(pixels_ * components * channels);
    for (std::size_t p = 0; p < pixels_; ++p)
      for (std::size_t component = 0; component < components; ++component) {
        const float* const row = values.data() + (p * components + component) * carried;
        for (std::size_t c = 0; c < channels; ++c) made.push_back(static_cast<float>(sum(p, c, row, as)));
      }
    return made;
  }

  /// By how much more the variances of a tile's pixels count in a channel than in what is carried of it.
  double weight_of_variance(const std::vector<float>& variance, std::size_t channel, std::size_t k) const {
    const std::size_t at = responses_.first(channel) + k;
    double with = 0.0, without = 0.0;
    for (std::size_t p = 0; p < pixels_; ++p) {
      const int column = column_of(p);
      const double own = static_cast<double>(variance[p * responses_.carried() + at]);
      const double weight = std::abs(static_cast<double>(responses_.weights(channel, column)[k]));
      with += own * weight * responses_.spread(channel, column);
      without += own;
    }
    return without > 0.0 ? with / without : 0.0;
  }

 private:
  int column_of(std::size_t pixel) const { return tile_.x0 + static_cast<int>(pixel) % tile_.width(); }

  double sum(std::size_t pixel, std::size_t channel, const float* row, As as) const {
    const std::span<const float> weights = responses_.weights(channel, column_of(pixel));
    const float* const own = row + responses_.first(channel);
    double sum = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double weight = static_cast<double>(weights[k]), value = static_cast<double>(own[k]);
      sum += as == As::mean     ? weight * value
             : as == As::spread ? std::abs(weight) * value
                                : std::abs(weight) * std::sqrt(value);
    }
    return as == As::variance ? sum * sum : sum;
  }

  const sensor::ColumnResponses& responses_;
  const sampling::PixelRect tile_;
  std::size_t pixels_;
};

void mix_layers(const Mixing& mixing, std::size_t carried, std::size_t channels, sampling::TileResult& tile) {
  const auto as_of = [](std::string_view name) -> std::optional<As> {
    if (name == PartLayers::kMean || name == StokesLayers::kMean || name == StokesLayers::kBefore ||
        name == kEmissivityLayer)
      return As::mean;
    if (name == PartLayers::kStandardError || name == StokesLayers::kStandardError ||
        name == StokesLayers::kHalfWidth || name == kThermalLayer)
      return As::spread;
    return std::nullopt;
  };
  for (sampling::TileLayer& layer : tile.layers) {
    const std::optional<As> as = as_of(layer.name);
    if (!as) continue;
    const std::vector<float> made = mixing(layer.values<float>(), *as);
    layer.bands = static_cast<std::uint32_t>(layer.bands / carried * channels);
    layer.bytes.resize(made.size() * sizeof(float));
    if (!made.empty()) std::memcpy(layer.bytes.data(), made.data(), layer.bytes.size());
  }
}

std::vector<sampling::ColumnError> mixed(const Mixing& mixing, const sensor::ColumnResponses& responses,
                                         const std::vector<float>& mean, const std::vector<float>& variance,
                                         const std::vector<sampling::ColumnError>& carried) {
  std::vector<sampling::ColumnError> made(responses.channels());
  for (std::size_t at = 0; at < mean.size(); ++at)
    made[at % made.size()].mean_sum += static_cast<double>(mean[at]);
  for (std::size_t c = 0; c < made.size(); ++c)
    for (std::size_t k = 0; k < responses[c].carried.size(); ++k) {
      const sampling::ColumnError& own = carried[responses.first(c) + k];
      made[c].variance_sum += own.variance_sum * mixing.weight_of_variance(variance, c, k);
      made[c].audited = std::max(made[c].audited, own.audited);
      made[c].limit = k == 0 ? own.limit : std::min(made[c].limit, own.limit);
    }
  return made;
}

}  // namespace

void make_channels(const sensor::ColumnResponses& responses, sampling::TileResult& tile) {
  const Mixing mixing(responses, tile.tile);
  const std::size_t channels = responses.channels();
  mix_layers(mixing, responses.carried(), channels, tile);
  std::vector<float> mean = mixing(tile.mean, As::mean);
  if (!tile.column_errors.empty()) {
    std::vector<float> variance = tile.variance_geometry;
    for (std::size_t at = 0; at < variance.size(); ++at) variance[at] += tile.variance_path[at];
    tile.column_errors = mixed(mixing, responses, mean, variance, tile.column_errors);
  }
  tile.mean = std::move(mean);
  tile.variance_geometry = mixing(tile.variance_geometry, As::variance);
  tile.variance_path = mixing(tile.variance_path, As::variance);
  tile.half_width = mixing(tile.half_width, As::spread);
  for (std::size_t at = 0; at < tile.half_width.size(); ++at)
    tile.half_width[at] +=
        static_cast<float>(responses[at % channels].left_out * std::abs(static_cast<double>(tile.mean[at])));
  tile.columns = static_cast<int>(channels);
}

}  // namespace ifov::render
