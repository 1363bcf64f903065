#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/product_parts/run_record.h"
#include "io/products/product_writer.h"
#include "render/tile_sink.h"

namespace ifov::test {

/// An empty folder that goes away with the object.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("ifov_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_all(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A layer with these values.
template <class Value>
sampling::TileLayer layer_of(std::string_view name, std::uint32_t bands, const std::vector<Value>& values) {
  const auto bytes = std::as_bytes(std::span<const Value>(values));
  return {std::string(name), sizeof(Value), bands, {bytes.begin(), bytes.end()}};
}

/// Every value of a synthetic image names its place: radiance, counts and fractions are functions of (x, y,
/// channel).
struct SyntheticImage {
  int width = 0, height = 0, channels = 0, materials = 3;

  float radiance(int x, int y, int c) const {
    const double u = (x + 0.5) / width, v = (y + 0.5) / height;
    const double disc = std::hypot(u - 0.5, v - 0.5) < 0.3 ? 1.0 : 0.35;
    return static_cast<float>(
        disc * (20.0 + 60.0 * std::exp(-0.5 * std::pow((c + 1.0) / channels * 4.0 - 1.5, 2))) + 0.37 * x +
        0.011 * y);
  }
  float half_width(int x, int y, int c) const {
    return 0.01f * radiance(x, y, c) * (1.0f + 0.5f * static_cast<float>((x + y) % 3));
  }
  std::uint32_t samples(int x, int y) const {
    return 9u + static_cast<std::uint32_t>((x * 7 + y * 13) % 200);
  }
  float ratio(int x, int y) const { return 0.02f * static_cast<float>((x * 3 + y * 5) % 60); }
  sampling::Reasons reasons(int x, int y) const {
    if (ratio(x, y) <= 1.0f) return 0;
    const sampling::Reasons samples = sampling::bit(sampling::Reason::samples);
    return static_cast<sampling::Reasons>(
        y % 2 == 0 ? samples : samples | sampling::bit(sampling::Reason::unseen_light));
  }
  float fraction(int x, int y) const { return static_cast<float>((x + 2 * y) % 11) / 10.0f; }

  render::ImageInfo info() const {
    render::ImageInfo result;
    result.width_px = width;
    result.height_px = height;
    for (int c = 0; c < channels; ++c)
      result.channels.push_back(
          {"ch" + std::to_string(c + 1), 0.4 + 2.1 * c / std::max(1, channels - 1), 0.01});
    for (int m = 0; m < materials; ++m) result.materials.push_back("material " + std::to_string(m + 1));
    result.has_map = true;
    result.map_x_m = 1000.0;
    result.map_y_m = 2000.0;
    result.gsd_m = 0.5;
    result.map_projection = "Arbitrary";
    return result;
  }

  sampling::TileResult tile(sampling::PixelRect rect) const {
    sampling::TileResult result;
    result.reset(rect, channels);
    std::size_t p = 0;
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x, ++p) {
        for (int c = 0; c < channels; ++c) {
          const std::size_t i = p * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c);
          result.mean[i] = radiance(x, y, c);
          result.half_width[i] = half_width(x, y, c);
          const float error = result.half_width[i] / 1.96f;
          result.variance_geometry[i] = 0.75f * error * error;
          result.variance_path[i] = 0.25f * error * error;
        }
        result.samples[p] = samples(x, y);
        result.label_rays[p] = samples(x, y) - 4;
        result.radiance_evaluations[p] = 4;
        result.worst_ratio[p] = ratio(x, y);
        result.reasons[p] = reasons(x, y);
        result.missable_fraction[p] = 0.02f;
        result.abundances.push_back({static_cast<std::uint32_t>(p), 0, fraction(x, y), 0.01f});
        if (materials > 2)
          result.abundances.push_back({static_cast<std::uint32_t>(p), 2, 1.0f - fraction(x, y), 0.02f});
        result.rays.primary += samples(x, y);
        result.rays.shadow += 4;
      }
    result.halo_samples = 5;
    return result;
  }

  std::vector<sampling::PixelRect> tiles(int side) const {
    std::vector<sampling::PixelRect> result;
    for (int y = 0; y < height; y += side)
      for (int x = 0; x < width; x += side)
        result.push_back({x, y, std::min(x + side, width), std::min(y + side, height)});
    return result;
  }

  io::RunIdentity identity() const {
    return {"0.1.0", "scenes/demo.json", "{\n  // a scene </script> & more\n  \"sampler\": \"accuracy\"\n}\n",
            42,      "accuracy",         "1 % of radiance",
            0.95};
  }
  io::RunOutcome outcome() const {
    return {"Asked for 1 % at 95 % confidence per pixel and channel; reached in 98.3 % of pixels.",
            "A compact feature of 2 % of a pixel's area was found with probability of at least 95 %.",
            {"Floor: 0.1 % of a white Lambertian surface's radiance."},
            12.5,
            2,
            "2026-01-02T03:04:05Z"};
  }
};

}  // namespace ifov::test
