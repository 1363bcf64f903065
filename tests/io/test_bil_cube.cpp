#include <gtest/gtest.h>

#include <atomic>
#include <span>
#include <thread>
#include <vector>

#include "io/products/bil_cube.h"
#include "io/written_image.h"

namespace ifov::io::test_bil_cube {
namespace {

using namespace written_image;

TEST(BilCube, TellsUpToWhichLineItIsWritten) {
  const SyntheticImage image{20, 12, 5};
  const ScratchFolder folder("lines");
  BilCube cube(folder.path() / "x.img", image.width, image.height, image.channels, BilCube::Values::real);
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

TEST(BilCube, BoundedMemoryHoldsWhatComesInAnyOrder) {
  for (const int width : {256, 100}) {
    const SyntheticImage image{width, 70, 5};
    const ScratchFolder folder("bounded");
    BilCube cube(folder.path() / "x.img", image.width, image.height, image.channels, BilCube::Values::real,
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

}  // namespace
}  // namespace ifov::io::test_bil_cube
