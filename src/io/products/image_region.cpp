#include "io/products/image_region.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/error.h"

namespace ifov::io {
namespace {

constexpr const char* kExpected =
    "expected x0,y0,x1,y1 (a rectangle), x,y of three corners or more, both in pixels or after 'map:' in map coordinates, "
    "or mask:FILE";

std::vector<double> numbers_of(const std::string& text, std::string_view list) {
  std::vector<double> numbers;
  while (true) {
    const auto comma = list.find(',');
    std::string_view item = list.substr(0, comma);
    while (!item.empty() && item.front() == ' ') item.remove_prefix(1);
    while (!item.empty() && item.back() == ' ') item.remove_suffix(1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc() || stop != item.data() + item.size() || !std::isfinite(value))
      throw InputError(format("region '{}': '{}' is no number; {}", text, item, kExpected));
    numbers.push_back(value);
    if (comma == std::string_view::npos) return numbers;
    list.remove_prefix(comma + 1);
  }
}

std::vector<std::array<double, 2>> corners_of(const std::string& text, const std::vector<double>& n) {
  if (n.size() < 4 || n.size() % 2 != 0)
    throw InputError(
        format("region '{}': found {} number{}; {}", text, n.size(), n.size() == 1 ? "" : "s", kExpected));
  if (n.size() == 4) return {{{n[0], n[1]}, {n[2], n[1]}, {n[2], n[3]}, {n[0], n[3]}}};
  std::vector<std::array<double, 2>> corners;
  for (std::size_t k = 0; k < n.size(); k += 2) corners.push_back({n[k], n[k + 1]});
  return corners;
}

/// Image point of map coordinates.
std::array<double, 2> on_image(const std::array<double, 6>& g, const std::array<double, 2>& map) {
  const double x = map[0] - g[0], y = map[1] - g[3], determinant = g[1] * g[5] - g[2] * g[4];
  return {(g[5] * x - g[2] * y) / determinant, (g[1] * y - g[4] * x) / determinant};
}

bool taken(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

ImageRegion ImageRegion::parse(const std::string& text, const Image& image) {
  ImageRegion region;
  region.width_ = image.width_px;
  region.end_line_ = image.height_px;
  std::string_view rest = text;
  if (taken(rest, "mask:")) {
    region.mask_.emplace(std::filesystem::path(rest));
    const EnviHeader& header = region.mask_->header();
    if (header.samples != image.width_px || header.lines != image.height_px)
      throw InputError(format("region '{}': the mask has {} x {} pixels, expected the image's {} x {}", text,
                              header.samples, header.lines, image.width_px, image.height_px));
  } else {
    const bool on_map = taken(rest, "map:");
    if (on_map && !image.map)
      throw InputError(format("region '{}': the image has no map coordinates; expected pixels", text));
    region.corners_ = corners_of(text, numbers_of(text, rest));
    double low = image.height_px, high = 0.0;
    for (auto& corner : region.corners_) {
      if (on_map) corner = on_image(*image.map, corner);
      low = std::min(low, corner[1]);
      high = std::max(high, corner[1]);
    }
    region.first_line_ =
        static_cast<int>(std::clamp(std::floor(low), 0.0, static_cast<double>(image.height_px)));
    region.end_line_ =
        static_cast<int>(std::clamp(std::ceil(high), 0.0, static_cast<double>(image.height_px)));
  }
  region.require_pixels(text);
  return region;
}

void ImageRegion::select(int line, std::vector<std::uint8_t>& inside) const {
  inside.assign(static_cast<std::size_t>(width_), 0);
  if (mask_) {
    std::vector<float> values(inside.size());
    mask_->read(line, 0, values);
    for (std::size_t x = 0; x < values.size(); ++x) inside[x] = values[x] != 0.0f && !std::isnan(values[x]);
    return;
  }
  const double y = line + 0.5;
  std::vector<double> crossings;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const auto &a = corners_[k], &b = corners_[(k + 1) % corners_.size()];
    if ((a[1] <= y) == (b[1] <= y)) continue;
    crossings.push_back(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
  }
  std::sort(crossings.begin(), crossings.end());
  const auto first_at = [&](double x) {
    return static_cast<std::size_t>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width_)));
  };
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
    for (std::size_t x = first_at(crossings[k]); x < first_at(crossings[k + 1]); ++x) inside[x] = 1;
}

void ImageRegion::require_pixels(const std::string& text) const {
  std::vector<std::uint8_t> inside;
  for (int line = first_line_; line < end_line_; ++line) {
    select(line, inside);
    if (std::find(inside.begin(), inside.end(), 1) != inside.end()) return;
  }
  throw InputError(format("region '{}': no pixel's centre lies in it", text));
}

}  // namespace ifov::io
