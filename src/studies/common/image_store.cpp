#include "studies/common/image_store.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ifov::studies {

void ImageStore::begin(const render::ImageInfo& info) {
  width_ = info.width_px;
  height_ = info.height_px;
  columns_ = static_cast<int>(info.channels.size());
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  mean_.assign(pixels * info.channels.size(), 0.0f);
  half_width_.assign(mean_.size(), std::numeric_limits<float>::quiet_NaN());
  samples_.assign(pixels, 0);
  converged_.assign(pixels, 0);
  abundances_.assign(pixels, {});
  cost_ = {};
  stated_squares_.clear();
}

void ImageStore::write(const sampling::TileResult& tile) {
  Cost cost;
  cost.halo = cost.samples = tile.halo_samples;
  cost.pilot = tile.pilot_samples;
  cost.probe = tile.probe_samples;
  cost.rays = tile.rays;
  const std::size_t columns = static_cast<std::size_t>(columns_);
  std::size_t from = 0;
  for (int j = tile.tile.y0; j < tile.tile.y1; ++j)
    for (int i = tile.tile.x0; i < tile.tile.x1; ++i, ++from) {
      const std::size_t to = index(i, j);
      std::copy_n(&tile.mean[from * columns], columns, &mean_[to * columns]);
      if (tile.has_errors())
        std::copy_n(&tile.half_width[from * columns], columns, &half_width_[to * columns]);
      samples_[to] = tile.samples[from];
      converged_[to] = tile.converged(from);
      cost.samples += tile.samples[from];
      cost.radiance += tile.radiance_evaluations[from];
    }
  // Tiles share no pixel: only the sums need the lock.
  for (sampling::Abundance found : tile.abundances) {
    const int pixel = static_cast<int>(found.pixel);
    const std::size_t to =
        index(tile.tile.x0 + pixel % tile.tile.width(), tile.tile.y0 + pixel / tile.tile.width());
    found.pixel = static_cast<std::uint32_t>(to);
    abundances_[to].push_back(found);
  }
  const std::scoped_lock lock(mutex_);
  cost_ += cost;
  if (tile.column_errors.empty()) return;
  stated_squares_.resize(columns);
  for (std::size_t c = 0; c < columns; ++c) {
    const sampling::ColumnError& error = tile.column_errors[c];
    stated_squares_[c] += error.variance_sum * (error.audited > 0.0f ? double(error.audited) : 1.0);
  }
}

std::vector<double> ImageStore::stated_rms() const {
  std::vector<double> rms;
  for (const double squares : stated_squares_) rms.push_back(std::sqrt(squares / double(samples_.size())));
  return rms;
}

ImageStore::Cost& ImageStore::Cost::operator+=(const Cost& other) {
  samples += other.samples;
  halo += other.halo;
  pilot += other.pilot;
  probe += other.probe;
  radiance += other.radiance;
  rays.primary += other.rays.primary;
  rays.shadow += other.rays.shadow;
  rays.continuation += other.rays.continuation;
  return *this;
}

}  // namespace ifov::studies
