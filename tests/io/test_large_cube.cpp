#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

#include "core/error.h"
#include "io/products/cube_file.h"
#include "io/small_disk.h"
#include "io/synthetic_image.h"

namespace ifov::io::test_large_cube {
namespace {

using test::ScratchFolder;
using test::SmallDisk;
using test::SyntheticImage;

constexpr std::uint64_t kAlways = 0;
constexpr std::size_t kPlenty = std::size_t{192} << 20, kLittle = 1;  // room for all strips; for two

bool can_bypass(const std::filesystem::path& folder) {
  const int file = open((folder / "probe").c_str(), O_WRONLY | O_CREAT | O_DIRECT, 0644);
  if (file >= 0) close(file);
  return file >= 0;
}

/// The share of a file's pages that lie in the page cache.
double cached_share(const std::filesystem::path& path) {
  const std::size_t bytes = std::filesystem::file_size(path);
  const int file = open(path.c_str(), O_RDONLY);
  void* memory = mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file, 0);
  close(file);
  std::vector<unsigned char> pages((bytes + 4095) / 4096);
  const int code = mincore(memory, bytes, pages.data());
  munmap(memory, bytes);
  if (code != 0) return 1.0;
  return static_cast<double>(
             std::count_if(pages.begin(), pages.end(), [](unsigned char p) { return (p & 1) != 0; })) /
         static_cast<double>(pages.size());
}

std::string sha256_of(const std::string& bytes) {
  Sha256 sum;
  sum.update(bytes.data(), bytes.size());
  return sum.digest();
}

/// Strips of 2 to 3 MB: enough to go past the cache.
void write_cube(CubeFile& cube, const SyntheticImage& image, bool in_order, int threads) {
  std::vector<sampling::PixelRect> tiles = image.tiles(64);
  std::mt19937 random(7);
  if (!in_order) std::shuffle(tiles.begin(), tiles.end(), random);
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&] {
      for (std::size_t k; (k = next++) < tiles.size();)
        cube.write(tiles[k], std::span<const float>(image.tile(tiles[k]).mean));
    });
  for (auto& worker : workers) worker.join();
  cube.flush();
}

TEST(LargeCube, HoldsTheSameAndIsScannedInAnyOrder) {
  for (const int width :
       {1000, 1024})  // whose strips begin within a block, and whose rows are padded in memory
    for (const auto& [in_order, buffer] : {std::pair(true, kPlenty), {false, kPlenty}, {false, kLittle}})
      for (const int threads : {1, 4}) {
        const SyntheticImage image{width, 210, 11};
        const ScratchFolder folder("large_cube");
        CubeFile cube(folder.path() / "x.img", image.width, image.height, image.channels,
                      CubeFile::Values::real, {.buffer_bytes = buffer, .large_bytes = kAlways});
        cube.scan().want_figures();
        cube.reserve();
        write_cube(cube, image, in_order, threads);
        if (can_bypass(folder.path()) && in_order && threads == 1) {
          EXPECT_LT(cached_share(folder.path() / "x.img.part"), 0.2);
        }
        cube.finish_scan();

        const std::string bytes = test::read_all(folder.path() / "x.img.part");
        ASSERT_EQ(bytes.size(), cube.bytes());
        EXPECT_EQ(cube.scan().checksum(), sha256_of(bytes));
        double sum = 0.0, squares = 0.0;
        for (int y = 0; y < image.height; ++y)
          for (int c = 0; c < image.channels; ++c)
            for (int x = 0; x < image.width; ++x) {
              float value;
              const int at = (y * image.channels + c) * image.width + x;
              std::memcpy(&value, bytes.data() + 4 * static_cast<std::size_t>(at), 4);
              ASSERT_EQ(value, image.radiance(x, y, c)) << x << " " << y << " " << c;
              if (c == 3) sum += value, squares += static_cast<double>(value) * value;
            }
        const double n = image.width * image.height;
        const BandFigures& figures = cube.scan().figures()[3];
        EXPECT_EQ(figures.finite(), static_cast<std::uint64_t>(n));
        EXPECT_NEAR(figures.mean(), sum / n, 1e-9 * sum / n);
        EXPECT_NEAR(figures.standard_deviation(), std::sqrt(squares / n - sum / n * (sum / n)),
                    1e-6 * sum / n);
      }
}

TEST(LargeCube, ADiskFullInTheBackgroundIsSaid) {
  const ScratchFolder folder("large_full");
  const SmallDisk disk(folder.path(), "size=4m");
  if (!disk.mounted()) GTEST_SKIP() << "a small file system can be mounted by root only";
  const SyntheticImage image{1024, 256, 11};
  CubeFile cube(folder.path() / "x.img", image.width, image.height, image.channels, CubeFile::Values::real,
                {.large_bytes = kAlways});
  try {
    for (const auto& tile : image.tiles(64)) cube.write(tile, std::span<const float>(image.tile(tile).mean));
    cube.flush();
    FAIL() << "11.5 MB on a disk of 4 MB";
  } catch (const SystemError& error) {
    EXPECT_NE(std::string(error.what()).find("x.img.part: the disk is full: "), std::string::npos)
        << error.what();
  }
}

TEST(PartFile, PiecesPastTheCacheAtAnyPlace) {
  const ScratchFolder folder("pieces");
  PartFile file(folder.path() / "x");
  file.bypass_page_cache();
  std::string expected(9000000, '\0');
  std::mt19937 random(3);
  for (const auto& [offset, bytes] : std::vector<std::pair<std::size_t, std::size_t>>{
           {0, 4096}, {1, 2000001}, {2000002, 3000000}, {5001216, 1 << 20}, {6100000, 2900000}}) {
    std::string data(bytes, ' ');
    for (char& c : data) c = static_cast<char>(random());
    std::vector<iovec> pieces;
    for (std::size_t begin = 0, length = 1; begin < bytes; begin += length, length = 1 + random() % 9000)
      pieces.push_back({data.data() + begin, std::min(length, bytes - begin)});
    for (std::size_t k = 0; k + 1 < pieces.size(); ++k)  // lengths as they really follow one another
      pieces[k].iov_len = static_cast<std::size_t>(static_cast<char*>(pieces[k + 1].iov_base) -
                                                   static_cast<char*>(pieces[k].iov_base));
    file.write_at(offset, pieces);
    expected.replace(offset, bytes, data);
  }
  file.sync();
  EXPECT_TRUE(test::read_all(folder.path() / "x.part") == expected);
  std::string again(1000, ' ');
  file.read_at(4999000, again.data(), again.size());
  EXPECT_EQ(again, expected.substr(4999000, 1000));
}

TEST(BandFigures, LeaveAwayWhatIsNotFinite) {
  BandFigures none;
  const std::vector<float> empty(5, std::nanf(""));
  none.add(empty);
  EXPECT_EQ(none.not_finite(), 5u);
  EXPECT_TRUE(std::isnan(none.mean()) && std::isnan(none.minimum()) && std::isnan(none.standard_deviation()));

  BandFigures figures;
  std::vector<float> values(1003);
  double sum = 0.0;
  std::uint64_t finite = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = i % 7 == 0    ? std::nanf("")
                : i % 11 == 0 ? -std::numeric_limits<float>::infinity()
                              : 1.0f + 0.25f * static_cast<float>(i);
    if (std::isfinite(values[i])) sum += values[i], ++finite;
  }
  figures.add(std::span(values).first(500));
  figures.add(std::span(values).subspan(500));
  EXPECT_EQ(figures.finite(), finite);
  EXPECT_EQ(figures.not_finite(), values.size() - finite);
  EXPECT_NEAR(figures.mean(), sum / static_cast<double>(finite), 1e-10);
  EXPECT_EQ(figures.minimum(), 1.25);
  EXPECT_EQ(figures.maximum(), 1.0 + 0.25 * 1002);
}

TEST(BandFigures, DoNotDependOnWhereLinesEnd) {
  const std::vector<float> values{1005.0f, 1007.0f, 1009.0f};
  for (const std::size_t first : {0, 1, 2, 3}) {
    BandFigures figures;
    figures.add(std::span(values).first(first));
    figures.add(std::span(values).subspan(first));
    EXPECT_EQ(figures.mean(), 1007.0) << first;
    EXPECT_NEAR(figures.standard_deviation(), std::sqrt(8.0 / 3.0), 1e-12) << first;
  }
}

}  // namespace
}  // namespace ifov::io::test_large_cube
