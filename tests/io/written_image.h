#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "io/products/envi_reader.h"
#include "io/quantities/quality_classes.h"
#include "io/quantities/quantity.h"
#include "io/synthetic_image.h"

// Images written as products, for the tests of what is in them, of their files and of their folders.
namespace ifov::io::written_image {

using test::ScratchFolder;
using test::SyntheticImage;

inline ProductOptions options_in(const std::filesystem::path& folder) {
  ProductOptions options;
  options.folder = folder;
  options.name = "demo";
  options.cubes = QuantitySet::all();
  for (const Quantity* quantity : all_quantities())  // the synthetic image has no scene, nor light in parts
    if (quantity->collector != nullptr || quantity->needs.parts || quantity->needs.emissivity)
      options.cubes.remove(*quantity);
  return options;
}

/// An order that is neither row by row nor the same for every seed.
inline std::vector<sampling::PixelRect> shuffled(std::vector<sampling::PixelRect> tiles, std::uint64_t seed) {
  for (std::size_t i = tiles.size(); i > 1; --i) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    std::swap(tiles[i - 1], tiles[(seed >> 33) % i]);
  }
  return tiles;
}

inline RunRecord write_image(const SyntheticImage& image, const ProductOptions& options,
                             const std::vector<sampling::PixelRect>& tiles, int threads = 1) {
  ProductWriter writer(options, image.identity());
  writer.begin(image.info());
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&] {
      for (std::size_t k; (k = next++) < tiles.size();) writer.write(image.tile(tiles[k]));
    });
  for (auto& worker : workers) worker.join();
  return writer.finish(image.outcome());
}

inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

template <class Expected>
void expect_cube(const std::filesystem::path& path, int bands, Expected expected) {
  const EnviReader reader(path);
  const EnviHeader& h = reader.header();
  ASSERT_EQ(h.bands, bands);
  ASSERT_EQ(std::filesystem::file_size(path), h.data_bytes());
  std::vector<float> line(static_cast<std::size_t>(h.samples));
  for (int y = 0; y < h.lines; ++y)
    for (int b = 0; b < bands; ++b) {
      reader.read(y, b, line);
      for (int x = 0; x < h.samples; ++x)
        ASSERT_FLOAT_EQ(line[static_cast<std::size_t>(x)], expected(x, y, b))
            << path << ' ' << x << ' ' << y << ' ' << b;
    }
}

inline void expect_all_cubes(const SyntheticImage& image, const std::filesystem::path& folder) {
  const auto at = [&](const char* ending) { return folder / (std::string("demo") + ending); };
  expect_cube(at("_radiance.img"), image.channels,
              [&](int x, int y, int c) { return image.radiance(x, y, c); });
  expect_cube(at("_half_width.img"), image.channels,
              [&](int x, int y, int c) { return image.half_width(x, y, c); });
  expect_cube(at("_standard_error.img"), image.channels,
              [&](int x, int y, int c) { return image.half_width(x, y, c) / 1.96f; });
  expect_cube(at("_samples.img"), 3, [&](int x, int y, int b) {
    return b == 2 ? 4.0f : static_cast<float>(image.samples(x, y) - (b == 1 ? 4u : 0u));
  });
  expect_cube(at("_quality.img"), 4, [&](int x, int y, int b) {
    if (b == 0) return image.ratio(x, y) <= 1.0f ? 1.0f : 0.0f;
    return b == 1 ? image.ratio(x, y) : b == 2 ? 0.02f : 0.75f;
  });
  expect_cube(at("_reasons.img"), 1,
              [&](int x, int y, int) { return static_cast<float>(image.reasons(x, y)); });
  expect_cube(at("_quality_class.img"), 1,
              [&](int x, int y, int) { return static_cast<float>(class_of(image.reasons(x, y))); });
  expect_cube(at("_abundance.img"), 3, [&](int x, int y, int m) {
    return m == 0 ? image.fraction(x, y) : m == 2 ? 1.0f - image.fraction(x, y) : 0.0f;
  });
  expect_cube(at("_abundance_half_width.img"), 3, [](int, int, int m) {
    return m == 0 ? 0.01f : m == 2 ? 0.02f : 0.0f;
  });
}

}  // namespace ifov::io::written_image
