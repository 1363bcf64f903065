#include "render/polarized/stokes_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "radiometry/spectral_nodes.h"
#include "render/parts/light_told.h"
#include "render/parts/part_columns.h"
#include "render/polarized/polarimetry.h"
#include "render/polarized/steering.h"
#include "sampling/tile.h"

namespace ifov::render {

namespace {

const Polarimetry kNoPolarimetry{};

sampling::TileLayer float_layer(const char* name, std::size_t bands, const std::vector<float>& values) {
  sampling::TileLayer layer{name, sizeof(float), static_cast<std::uint32_t>(bands),
                            std::vector<std::byte>(values.size() * sizeof(float))};
  if (!values.empty()) std::memcpy(layer.bytes.data(), values.data(), layer.bytes.size());
  return layer;
}

}  // namespace

StokesColumns::StokesColumns(const LightTold& told, const radiometry::SpectralNodes& nodes)
    : polarimetry_(told.polarimetry != nullptr ? *told.polarimetry : kNoPolarimetry),
      nodes_(nodes),
      channels_(nodes.channel_count()),
      parts_(std::make_unique<const PartColumns>(told.parts, polarimetry_.columns(channels_), nodes)),
      work_(4 * channels_) {}

StokesColumns::~StokesColumns() = default;

int StokesColumns::leader(int column) const {
  const auto at = static_cast<std::size_t>(column);
  if (at < parts_->first() || at >= parts_->first() + parts_->count()) return column;
  return static_cast<int>((at - parts_->first()) % channels_);
}

int StokesColumns::channel_of(int column) const {
  return static_cast<int>(static_cast<std::size_t>(leader(column)) % channels_);
}

std::size_t StokesColumns::count() const { return polarimetry_.columns(channels_) + parts_->count(); }

bool StokesColumns::told() const { return polarimetry_.stokes; }

void add_stokes_columns(const Polarimetry* polarimetry, std::size_t channels, std::vector<int>& columns) {
  if (polarimetry == nullptr || !polarimetry->stokes) return;
  const std::size_t judged = columns.size();
  for (std::size_t component = 1; component < 4; ++component)
    for (std::size_t k = 0; k < judged; ++k)
      columns.push_back(columns[k] + static_cast<int>(component * channels));
}

void StokesColumns::write_parts(std::span<const transport::StokesRows> parts, const float* transmittance,
                                float* row) {
  float* into = row + parts_->first();
  for (const transport::StokesRows& part : parts) {
    for (std::size_t c = 0; c < 4; ++c) nodes_.to_channels(part[c], work_.data() + c * channels_);
    const auto at = [&](std::size_t component, std::size_t channel) {
      return static_cast<double>(work_[component * channels_ + channel]);
    };
    for (std::size_t c = 0; c < channels_; ++c)
      *into++ = static_cast<float>(seen(c, {at(0, c), at(1, c), at(2, c), at(3, c)}).i);
  }
  parts_->write_transmittance(transmittance, row);
}

radiometry::StokesVector StokesColumns::seen(std::size_t channel,
                                             const radiometry::StokesVector& light) const {
  return polarimetry_.optics.empty() ? light : polarimetry_.optics[channel] * light;
}

void StokesColumns::pass(std::size_t channel, const radiometry::StokesVector& light, float* row) const {
  const radiometry::StokesVector seen = this->seen(channel, light);
  row[channel] = static_cast<float>(seen.i);
  if (!polarimetry_.optics.empty()) row[polarimetry_.told(channels_) + channel] = static_cast<float>(light.i);
  if (!polarimetry_.stokes) return;
  row[channels_ + channel] = static_cast<float>(seen.q);
  row[2 * channels_ + channel] = static_cast<float>(seen.u);
  row[3 * channels_ + channel] = static_cast<float>(seen.v);
}

void StokesColumns::write(const transport::StokesRows& light, float* row) {
  for (std::size_t c = 0; c < 4; ++c) nodes_.to_channels(light[c], work_.data() + c * channels_);
  if (polarimetry_.optics.empty()) {
    std::copy_n(work_.data(), polarimetry_.columns(channels_), row);
    return;
  }
  const auto at = [&](std::size_t component, std::size_t channel) {
    return static_cast<double>(work_[component * channels_ + channel]);
  };
  for (std::size_t c = 0; c < channels_; ++c) pass(c, {at(0, c), at(1, c), at(2, c), at(3, c)}, row);
}

void StokesColumns::write_unpolarized(std::span<const float> channels, float* row) {
  for (std::size_t c = 0; c < channels_; ++c) pass(c, {static_cast<double>(channels[c]), 0.0, 0.0, 0.0}, row);
}

void StokesColumns::settle(sampling::TileResult& tile) const {
  if (count() == channels_) return;
  const std::size_t pixels = static_cast<std::size_t>(tile.tile.count()), columns = count();
  // Columns from `first` on, and what is left of an array without them.
  const auto part = [&](const std::vector<float>& values, std::size_t first, std::size_t last) {
    std::vector<float> found;
    found.reserve(pixels * (last - first));
    for (std::size_t p = 0; p < pixels; ++p)
      found.insert(found.end(), values.begin() + static_cast<std::ptrdiff_t>(p * columns + first),
                   values.begin() + static_cast<std::ptrdiff_t>(p * columns + last));
    return found;
  };
  const std::size_t last = polarimetry_.told(channels_), others = last - channels_;
  parts_->add_layers(tile);
  if (last < polarimetry_.columns(channels_))
    tile.layers.push_back(
        float_layer(StokesLayers::kBefore, channels_, part(tile.mean, last, last + channels_)));
  if (told())
    tile.layers.push_back(float_layer(StokesLayers::kMean, others, part(tile.mean, channels_, last)));
  if (told() && tile.has_errors()) {
    std::vector<float> error(tile.variance_path.size());
    for (std::size_t k = 0; k < error.size(); ++k)
      error[k] = std::sqrt(tile.variance_geometry[k] + tile.variance_path[k]);
    tile.layers.push_back(float_layer(StokesLayers::kStandardError, last, part(error, 0, last)));
    tile.layers.push_back(
        float_layer(StokesLayers::kHalfWidth, others, part(tile.half_width, channels_, last)));
  }
  for (std::vector<float>* values :
       {&tile.mean, &tile.variance_geometry, &tile.variance_path, &tile.half_width})
    if (!values->empty()) *values = part(*values, 0, channels_);
  tile.columns = static_cast<int>(channels_);
}

}  // namespace ifov::render
