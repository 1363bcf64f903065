#include "io/report/report_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace ifov::io {

std::string base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < have ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= have ? kDigits[word >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string escape_html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

QuantisedRaster quantise(const RasterView& raster, int bands, int step) {
  constexpr double kCodes = 65534.0;
  QuantisedRaster result;
  result.width = (raster.width + step - 1) / step;
  result.height = (raster.height + step - 1) / step;
  const auto plane = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
  result.codes.reserve(2 * plane * static_cast<std::size_t>(bands));
  // Line by line, all bands of each: by pixel a line is not read again for each of them.
  std::vector<float> line(static_cast<std::size_t>(raster.width)),
      all(plane * static_cast<std::size_t>(bands));
  std::size_t before = 0;
  for (int y = 0; y < raster.height; y += step, before += static_cast<std::size_t>(result.width))
    for (int band = 0; band < bands; ++band) {
      raster.read(y, band, line);
      float* to = &all[static_cast<std::size_t>(band) * plane + before];
      for (std::size_t x = 0; x < line.size(); x += static_cast<std::size_t>(step)) *to++ = line[x];
    }
  for (int band = 0; band < bands; ++band) {
    const std::span<const float> values(&all[static_cast<std::size_t>(band) * plane], plane);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const float value : values)
      if (std::isfinite(value)) {
        low = std::min<double>(low, value);
        high = std::max<double>(high, value);
      }
    if (low > high) low = high = 0.0;
    result.low.push_back(low);
    result.high.push_back(high);
    const double scale = high > low ? kCodes / (high - low) : 0.0;
    for (const float value : values) {
      const unsigned code =
          std::isfinite(value) ? static_cast<unsigned>(std::lround((value - low) * scale)) : 65535u;
      result.codes += static_cast<char>(code & 255u);
      result.codes += static_cast<char>(code >> 8);
    }
  }
  return result;
}

Histogram histogram(const RasterView& raster, int band, int bins, bool whole) {
  std::vector<float> line(static_cast<std::size_t>(raster.width));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto each_value = [&](const auto& use) {
    for (int y = 0; y < raster.height; ++y) {
      raster.read(y, band, line);
      for (const float value : line)
        if (std::isfinite(value)) use(static_cast<double>(value));
    }
  };
  each_value([&](double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  });
  Histogram result;
  if (low > high) return result;
  result.logarithmic = low > 0.0 && high > 30.0 * low;
  if (whole && !result.logarithmic) {
    const double values_per_bin = std::ceil((high - low + 1.0) / bins);
    bins = static_cast<int>(std::ceil((high - low + 1.0) / values_per_bin));
    low -= 0.5;
    high = low + bins * values_per_bin;
  }
  if (!(high > low)) {
    low -= 0.5;
    high += 0.5;
  }
  const auto axis = [&](double v) { return result.logarithmic ? std::log(v) : v; };
  const double first = axis(low), span = axis(high) - first;
  for (int k = 0; k <= bins; ++k) {
    const double edge = first + span * k / bins;
    result.edges.push_back(result.logarithmic ? std::exp(edge) : edge);
  }
  result.counts.assign(static_cast<std::size_t>(bins), 0);
  each_value([&](double v) {
    const int bin = std::clamp(static_cast<int>((axis(v) - first) / span * bins), 0, bins - 1);
    ++result.counts[static_cast<std::size_t>(bin)];
  });
  return result;
}

int thinning_step(int width, int height, std::size_t bytes_per_pixel, std::size_t limit_bytes) {
  const auto size = [&](int step) {
    const auto w = static_cast<std::size_t>((width + step - 1) / step);
    const auto h = static_cast<std::size_t>((height + step - 1) / step);
    return w * h * bytes_per_pixel;
  };
  int step = 1;
  while (size(step) > limit_bytes && step < std::max(width, height)) ++step;
  return step;
}

}  // namespace ifov::io
