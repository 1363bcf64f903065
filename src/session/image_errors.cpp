#include "session/image_errors.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace ifov::session {

void ImageErrors::write(const sampling::TileResult& tile) {
  if (!tile.column_errors.empty()) {
    const std::scoped_lock lock(mutex_);
    tiles_[{tile.tile.y0, tile.tile.x0}] = {tile.column_errors, tile.samples.size()};
  }
  next_.write(tile);
}

std::vector<io::ImageError> ImageErrors::errors() const {
  const std::scoped_lock lock(mutex_);
  std::vector<io::ImageError> errors;
  double pixels = 0.0;
  for (const auto& [place, tile] : tiles_) {
    errors.resize(tile.columns.size());
    pixels += static_cast<double>(tile.pixels);
    for (std::size_t c = 0; c < errors.size(); ++c) {
      const sampling::ColumnError& column = tile.columns[c];
      errors[c].mean += column.mean_sum;
      errors[c].reached +=
          column.variance_sum * (column.audited > 0.0f ? static_cast<double>(column.audited) : 1.0);
      errors[c].limit = static_cast<double>(column.limit);
      errors[c].audited = column.audited > 0.0f;
    }
  }
  for (io::ImageError& error : errors) {
    error.mean /= pixels;
    error.reached = std::sqrt(error.reached / pixels);
  }
  return errors;
}

std::string image_error_statement(const std::vector<io::ImageError>& errors, const render::ImageInfo& image) {
  const bool audited = std::any_of(errors.begin(), errors.end(), [](const auto& e) { return e.audited; });
  const char* const by = audited ? "by an audit" : "as its samples tell it";
  std::vector<double> ratios;
  std::size_t reached = 0, worst = 0;
  for (std::size_t c = 0; c < errors.size(); ++c) {
    const io::ImageError& error = errors[c];
    if (!(error.limit > 0.0) || !std::isfinite(error.limit)) continue;
    ratios.push_back(error.reached / error.limit);
    reached += ratios.back() <= 1.0;
    if (ratios.size() == 1 || ratios.back() > errors[worst].reached / errors[worst].limit) worst = c;
  }
  if (ratios.empty()) {
    if (!audited) return {};
    double low = 1e300, high = 0.0;
    for (const io::ImageError& error : errors) {
      if (!(error.mean > 0.0)) continue;
      low = std::min(low, error.reached / error.mean);
      high = std::max(high, error.reached / error.mean);
    }
    return format("The RMS error over the image is {:.2g} to {:.2g} % of the channels' means, by an audit.",
                  100.0 * low, 100.0 * high);
  }
  const io::ImageError& most = errors[worst];
  const std::string name = worst < image.channels.size() ? image.channels[worst].name : std::string("?");
  std::sort(ratios.begin(), ratios.end());
  return format(
      "Reached in {} of {} channels, {}: the RMS over the image is {:.2f} of what rays may leave in the channel that has "
      "most of it ('{}': {:.3g} W m-2 sr-1 um-1, {:.2g} % of its mean), and {:.2f} in the middle one.",
      reached, ratios.size(), by, ratios.back(), name, most.reached,
      100.0 * most.reached / std::max(std::abs(most.mean), 1e-300), ratios[ratios.size() / 2]);
}

}  // namespace ifov::session
