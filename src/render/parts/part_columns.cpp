#include "render/parts/part_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "radiometry/spectral_nodes.h"
#include "radiometry/spectrum_block.h"
#include "sampling/tile.h"

namespace ifov::render {

using transport::kLightParts;
using transport::LightPart;

namespace {

sampling::TileLayer empty_layer(const char* name, std::size_t bands, std::size_t pixels) {
  return {name, sizeof(float), static_cast<std::uint32_t>(bands),
          std::vector<std::byte>(pixels * bands * sizeof(float))};
}

}  // namespace

void add_empty_part_layers(std::size_t channels, sampling::TileResult& tile) {
  const auto pixels = static_cast<std::size_t>(tile.tile.count());
  tile.layers.push_back(empty_layer(PartLayers::kMean, kLightParts * channels, pixels));
  if (tile.has_errors())
    tile.layers.push_back(empty_layer(PartLayers::kStandardError, kLightParts * channels, pixels));
}

PartColumns::PartColumns(bool told, std::size_t first, const radiometry::SpectralNodes& nodes)
    : told_(told), first_(first), channels_(nodes.channel_count()), nodes_(nodes) {
  if (!told) return;
  radiometry::SpectrumBlock one(1, nodes.node_count());
  std::fill_n(one.row(0), one.stride(), 1.0f);
  of_one_.resize(std::max(channels_, nodes.node_count()));
  nodes.to_channels(one.row(0), of_one_.data());
}

void PartColumns::write(const transport::PartRows& light, float* row) const {
  for (std::size_t p = 0; p < transport::kRadianceParts; ++p)
    nodes_.to_channels(light.row[p], row + first_ + p * channels_);
  write_transmittance(light[LightPart::transmittance], row);
}

void PartColumns::write_transmittance(const float* share, float* row) const {
  float* into = row + first_ + static_cast<std::size_t>(LightPart::transmittance) * channels_;
  nodes_.to_channels(share, into);
  for (std::size_t c = 0; c < channels_; ++c) into[c] /= of_one_[c];
}

void PartColumns::write_one(LightPart part, float* row) const {
  if (!told_) return;
  float* parts = row + first_;
  std::fill_n(parts, count(), 0.0f);
  std::copy_n(row, channels_, parts + static_cast<std::size_t>(part) * channels_);
}

void PartColumns::add_layers(sampling::TileResult& tile) const {
  if (!told_) return;
  const auto pixels = static_cast<std::size_t>(tile.tile.count()),
             columns = static_cast<std::size_t>(tile.columns);
  const auto add = [&](const char* name, const auto& value) {
    sampling::TileLayer layer = empty_layer(name, count(), pixels);
    std::vector<float> values(count());
    for (std::size_t p = 0; p < pixels; ++p) {
      for (std::size_t k = 0; k < count(); ++k) values[k] = value(p * columns + first_ + k);
      std::memcpy(layer.bytes.data() + p * count() * sizeof(float), values.data(), count() * sizeof(float));
    }
    tile.layers.push_back(std::move(layer));
  };
  add(PartLayers::kMean, [&](std::size_t at) { return tile.mean[at]; });
  if (tile.has_errors())
    add(PartLayers::kStandardError,
        [&](std::size_t at) { return std::sqrt(tile.variance_geometry[at] + tile.variance_path[at]); });
}

}  // namespace ifov::render
