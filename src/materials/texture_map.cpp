#include "materials/texture_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "sampling/hash.h"

namespace ifov::materials {

namespace {

/// Share of the sorted numbers that equal the first, where they pile up there.
template <class Iterator>
double piled_up(Iterator first, Iterator last) {
  const auto count_like = [&](Iterator from) {
    return std::find_if(from, last, [&](float v) { return v != *from; });
  };
  const Iterator next = count_like(first);
  if (next == last) return 0.0;
  const double here = static_cast<double>(next - first),
               beside = static_cast<double>(count_like(next) - next);
  const double share = here / static_cast<double>(last - first);
  return share > ImageScores::kClipped && here > 2.0 * beside ? share : 0.0;
}

}  // namespace

ImageScores score_image(std::span<const float> values, std::optional<double> nodata) {
  const auto known = [&](float v) {
    return std::isfinite(v) && !(nodata && v == static_cast<float>(*nodata));
  };
  ImageScores result;
  std::vector<float> sorted;
  sorted.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), known);
  result.unknown = values.size() - sorted.size();
  if (sorted.empty()) throw InputError("no cell of the image has a number");
  double sum = 0.0, squares = 0.0;
  for (const float v : sorted) sum += static_cast<double>(v);
  result.mean = sum / static_cast<double>(sorted.size());
  for (const float v : sorted) squares += std::pow(static_cast<double>(v) - result.mean, 2.0);
  result.deviation = std::sqrt(squares / static_cast<double>(sorted.size()));
  std::sort(sorted.begin(), sorted.end());
  result.lowest = static_cast<double>(sorted.front());
  result.highest = static_cast<double>(sorted.back());
  if (!(result.deviation > 0.0))
    throw InputError(format("all cells of the image hold the same number, {:g}", result.mean));
  result.clipped_low = piled_up(sorted.begin(), sorted.end());
  result.clipped_high = piled_up(sorted.rbegin(), sorted.rend());
  result.scores.reserve(values.size());
  for (const float v : values)
    result.scores.push_back(
        known(v) ? static_cast<float>((static_cast<double>(v) - result.mean) / result.deviation) : 0.0f);
  return result;
}

std::vector<double> range_means(std::span<const radiometry::Spectrum> curves,
                                std::span<const SpectralRange> ranges) {
  std::vector<double> means;
  for (const radiometry::Spectrum& curve : curves)
    for (const SpectralRange& range : ranges)
      means.push_back(radiometry::integral(curve, range.from_um, range.to_um) /
                      (range.to_um - range.from_um));
  return means;
}

TextureMap::Image::Image(MapGrid grid, std::vector<float> scores)
    : NumberedMap(grid), scores_(std::move(scores)) {
  check(grid_, scores_.size(), "an image of a texture");
  find_blocks();
}

TextureMap::TextureMap(std::vector<Image> images, CurveMatcher matcher, std::uint64_t seed)
    : images_(std::move(images)), matcher_(std::move(matcher)), seed_(seed) {
  if (images_.size() != matcher_.range_count())
    throw InputError(format("a texture of {} spectral ranges needs as many images: found {}",
                            matcher_.range_count(), images_.size()));
}

CurveMix TextureMap::at(const MapPosition& position) const {
  constexpr std::size_t kMost = 16;  // as CurveMatcher admits
  std::array<double, kMost> scores{};
  std::uint64_t key = seed_;
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const std::size_t cell = images_[k].grid().cell_at(position);
    scores[k] = static_cast<double>(images_[k].number(cell));
    key = sampling::hash(key, cell);
  }
  return matcher_.match({scores.data(), images_.size()}, key);
}

}  // namespace ifov::materials
