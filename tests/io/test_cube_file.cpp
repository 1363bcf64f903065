#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/format.h"
#include "io/product_parts/cube_tile.h"
#include "io/products/cube_file.h"
#include "io/products/cube_lines.h"
#include "io/written_image.h"

namespace ifov::io::test_cube_file {
namespace {

using namespace written_image;

TEST(CubeFile, TellsUpToWhichLineItIsWritten) {
  const SyntheticImage image{20, 12, 5};
  const ScratchFolder folder("lines");
  CubeFile cube(folder.path() / "x.img", image.width, image.height, image.channels, CubeFile::Values::real);
  const auto write = [&](sampling::PixelRect tile) {
    cube.write(tile, std::span<const float>(image.tile(tile).mean));
  };
  write({0, 4, 20, 8});
  EXPECT_EQ(cube.lines_written(), 0) << "what lies before is missing";
  write({0, 0, 8, 4});
  EXPECT_EQ(cube.lines_written(), 0) << "half a strip waits in memory";
  write({8, 0, 20, 4});
  EXPECT_EQ(cube.lines_written(), 8);
  write({0, 8, 8, 12});
  cube.flush();
  EXPECT_EQ(cube.lines_written(), 8) << "a part of the last strip is missing";
  write({8, 8, 20, 12});
  cube.flush();
  EXPECT_EQ(cube.lines_written(), 12);
}

TEST(CubeFile, BoundedMemoryHoldsWhatComesInAnyOrder) {
  for (const int width : {256, 100}) {
    const SyntheticImage image{width, 70, 5};
    const ScratchFolder folder("bounded");
    CubeFile cube(folder.path() / "x.img", image.width, image.height, image.channels, CubeFile::Values::real,
                  {.buffer_bytes = 1});
    const auto tiles = shuffled(image.tiles(8), 3);
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> workers;
    for (int t = 0; t < 4; ++t)
      workers.emplace_back([&] {
        for (std::size_t k; (k = next++) < tiles.size();)
          cube.write(tiles[k], std::span<const float>(image.tile(tiles[k]).mean));
      });
    for (auto& worker : workers) worker.join();
    cube.flush();
    EXPECT_EQ(cube.lines_written(), image.height) << "in pieces or whole";
    const RasterView view = cube.view();
    std::vector<float> line(static_cast<std::size_t>(width));
    for (int y = 0; y < image.height; ++y)
      for (int c = 0; c < image.channels; ++c) {
        view.read(y, c, line);
        for (int x = 0; x < width; ++x) ASSERT_EQ(line[static_cast<std::size_t>(x)], image.radiance(x, y, c));
      }
  }
}

/// However tiles come and whatever waits: each value lies where its layout has it, checksum and figures are of the whole, and it is read
/// back by lines and by tiles.
TEST(CubeFile, AllInterleavesHoldTheSameValues) {
  std::vector<std::string> figures;
  for (const EnviInterleave interleave : {EnviInterleave::bil, EnviInterleave::bsq, EnviInterleave::bip})
    for (const int width : {256, 100})
      for (const auto& [buffer, large] :
           {std::pair(std::size_t{1}, kManyBytes), {std::size_t{64} << 20, kManyBytes}, {1, 0}}) {
        const SyntheticImage image{width, 70, 5};
        const ScratchFolder folder("layouts");
        CubeFile cube(folder.path() / "x.img", image.width, image.height, image.channels,
                      CubeFile::Values::real, {.buffer_bytes = buffer, .large_bytes = large},
                      PartFile::Left::replace, interleave);
        cube.scan().want_figures();
        cube.reserve();
        const auto tiles = shuffled(image.tiles(8), 5);
        std::atomic<std::size_t> next{0};
        std::vector<std::thread> workers;
        for (int t = 0; t < 3; ++t)
          workers.emplace_back([&] {
            for (std::size_t k; (k = next++) < tiles.size();)
              cube.write(tiles[k], std::span<const float>(image.tile(tiles[k]).mean));
          });
        for (auto& worker : workers) worker.join();
        cube.flush();
        cube.finish_scan();

        const std::string bytes = test::read_all(folder.path() / "x.img.part");
        ASSERT_EQ(bytes.size(), cube.bytes());
        const RasterView view = cube.view();
        std::vector<float> line(static_cast<std::size_t>(width));
        for (int y = 0; y < image.height; ++y)
          for (int c = 0; c < image.channels; ++c) {
            view.read(y, c, line);
            for (int x = 0; x < width; ++x) {
              const int at = interleave == EnviInterleave::bsq   ? (c * image.height + y) * width + x
                             : interleave == EnviInterleave::bip ? (y * width + x) * image.channels + c
                                                                 : (y * image.channels + c) * width + x;
              float value;
              std::memcpy(&value, bytes.data() + 4 * static_cast<std::size_t>(at), 4);
              ASSERT_EQ(value, image.radiance(x, y, c))
                  << name_of(interleave) << ' ' << x << ' ' << y << ' ' << c;
              ASSERT_EQ(line[static_cast<std::size_t>(x)], value);
            }
          }
        for (const sampling::PixelRect tile : {sampling::PixelRect{7, 3, 40, 9}, {0, 60, width, 70}}) {
          std::vector<float> values(static_cast<std::size_t>(tile.count() * image.channels));
          read_cube_tile([&](std::uint64_t offset, void* to,
                             std::size_t count) { std::memcpy(to, bytes.data() + offset, count); },
                         cube.layout(), tile, values);
          EXPECT_EQ(values, image.tile(tile).mean) << name_of(interleave);
        }
        Sha256 whole;
        whole.update(bytes.data(), bytes.size());
        EXPECT_EQ(cube.scan().checksum(), whole.digest()) << name_of(interleave);
        if (width == 100)
          for (const BandFigures& band : cube.scan().figures())
            figures.push_back(format("{} {} {}", band.mean(), band.standard_deviation(), band.maximum()));
      }
  for (std::size_t k = 5; k < figures.size(); ++k) EXPECT_EQ(figures[k], figures[k % 5]);
}

TEST(CubeFile, WideAndWholeNumbersByPixelAndByBand) {
  for (const EnviInterleave interleave : {EnviInterleave::bsq, EnviInterleave::bip}) {
    const ScratchFolder folder("wide");
    CubeFile wide(folder.path() / "w.img", 9, 4, 3, CubeFile::Values::wide, PartFile::Left::replace,
                  interleave),
        whole(folder.path() / "i.img", 9, 4, 3, CubeFile::Values::integer, PartFile::Left::replace,
              interleave),
        one(folder.path() / "o.img", 9, 4, 1, CubeFile::Values::bits, PartFile::Left::replace, interleave);
    for (const sampling::PixelRect tile : {sampling::PixelRect{0, 0, 5, 4}, {5, 0, 9, 4}}) {
      std::vector<double> values;
      std::vector<std::uint32_t> numbers;
      std::vector<std::uint16_t> bits;
      for (int y = 0; y < 4; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
          bits.push_back(static_cast<std::uint16_t>(10 * y + x));
          for (int b = 0; b < 3; ++b) {
            values.push_back(1e9 + 100 * b + 10 * y + x + 0.25);
            numbers.push_back(static_cast<std::uint32_t>(100 * b + 10 * y + x));
          }
        }
      wide.write(tile, std::span<const double>(values));
      whole.write(tile, std::span<const std::uint32_t>(numbers));
      one.write(tile, std::span<const std::uint16_t>(bits));
    }
    wide.flush(), whole.flush(), one.flush();
    std::vector<double> doubles(9);
    std::vector<float> floats(9), small(9);
    for (int y = 0; y < 4; ++y)
      for (int b = 0; b < 3; ++b) {
        wide.wide_view().read(y, b, doubles);
        whole.view().read(y, b, floats);
        one.view().read(y, 0, small);
        for (int x = 0; x < 9; ++x) {
          ASSERT_EQ(doubles[static_cast<std::size_t>(x)], 1e9 + 100 * b + 10 * y + x + 0.25);
          ASSERT_EQ(floats[static_cast<std::size_t>(x)],
                    100.0F * static_cast<float>(b) + static_cast<float>(10 * y + x));
          ASSERT_EQ(small[static_cast<std::size_t>(x)], static_cast<float>(10 * y + x));
        }
      }
  }
}

/// Lines of a cube that is made line by line, whole or some bands at a time.
TEST(CubeLines, WholeLinesAndSomeBandsOfThem) {
  for (const EnviInterleave interleave : {EnviInterleave::bil, EnviInterleave::bsq, EnviInterleave::bip}) {
    const ScratchFolder folder("cube_lines");
    const CubeLayout layout{interleave, 11, 6, 4};
    PartFile lines(folder.path() / "a"), bands(folder.path() / "b");
    lines.reserve(2 * 11 * 6 * 4), bands.reserve(2 * 11 * 6 * 4);
    std::vector<std::uint16_t> all, expected(11 * 6 * 4);
    for (int y = 0; y < 6; ++y)
      for (int b = 0; b < 4; ++b)
        for (int x = 0; x < 11; ++x) {
          all.push_back(static_cast<std::uint16_t>(1000 * y + 100 * b + x));
          expected[layout.place(x, y, b)] = all.back();
        }
    const std::span<const std::byte> bytes = std::as_bytes(std::span(all));
    write_cube_lines(lines, layout, 2, 2, bytes.subspan(2 * 88, 4 * 88));
    write_cube_lines(lines, layout, 2, 0, bytes.first(2 * 88));
    for (int y = 5; y >= 0; --y) {
      const auto line = bytes.subspan(static_cast<std::size_t>(y) * 88, 88);
      write_cube_bands(bands, layout, 2, y, 3, line.subspan(66, 22));
      write_cube_bands(bands, layout, 2, y, 0, line.first(66));
    }
    for (const char* const name : {"a.part", "b.part"}) {
      const std::string file = test::read_all(folder.path() / name);
      ASSERT_EQ(file.size(), 2 * expected.size());
      EXPECT_EQ(std::memcmp(file.data(), expected.data(), file.size()), 0)
          << name << ' ' << name_of(interleave);
    }
  }
}

}  // namespace
}  // namespace ifov::io::test_cube_file
