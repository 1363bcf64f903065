#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include "ifov/detect.h"
#include "io/envi/cube_layout.h"
#include "io/products/envi_reader.h"
#include "io/synthetic_image.h"
#include "render/image_info.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/mosaic.h"
#include "session/detection/detection.h"
#include "session/line_cube.h"

namespace ifov::session::test_detection_parts {
namespace {

constexpr int kWidth = 21, kLines = 40, kChannels = 5;

render::ImageInfo image_of(bool with_mosaic) {
  render::ImageInfo image;
  image.width_px = kWidth, image.height_px = kLines;
  for (int c = 0; c < kChannels; ++c) {
    sensor::Detector detector;
    detector.electrons_per_radiance = 900.0 + 10.0 * c;
    detector.read_noise = 30.0, detector.one_over_f = 0.2;
    detector.gain = 3.0, detector.bits = 14.0;
    image.channels.push_back({"c" + std::to_string(c), 8.0 + c, 0.5});
    image.channels.back().detector = std::make_shared<const sensor::Detector>(detector);
  }
  if (with_mosaic)
    image.mosaic = std::make_shared<const sensor::Mosaic>(sensor::Mosaic{2, 3, {0, 3, 2, 1, 4, 0}});
  return image;
}

/// A cube of radiance that rises to the right, and from channel to channel.
void write_radiance(const std::filesystem::path& path, io::EnviInterleave interleave) {
  const io::CubeLayout layout{interleave, kWidth, kLines, kChannels};
  std::vector<float> values(kWidth * kLines * kChannels);
  for (int y = 0; y < kLines; ++y)
    for (int c = 0; c < kChannels; ++c)
      for (int x = 0; x < kWidth; ++x)
        values[layout.place(x, y, c)] = 5.0F + 0.1F * static_cast<float>(x) + static_cast<float>(c);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(4 * values.size()));
  std::ofstream(path.string() + ".hdr")
      << "ENVI\nsamples = " << kWidth << "\nlines = " << kLines << "\nbands = " << kChannels
      << "\ndata type = 4\ninterleave = " << io::name_of(interleave) << "\nbyte order = 0\n";
}

/// Counts of one realization, [line][band][sample].
std::vector<float> drawn(io::EnviInterleave interleave, bool with_mosaic, double most_drift_bytes) {
  const test::ScratchFolder folder("detection_parts");
  write_radiance(folder.path() / "r.img", interleave);
  const io::EnviReader radiance(folder.path() / "r.img");
  const std::vector<DetectedCube> asked{{DetectedQuantity::counts, folder.path() / "counts.img"}};
  for (const auto& cube :
       realize({&radiance, {}, {}}, image_of(with_mosaic), 7, asked, 3, nullptr, most_drift_bytes).cubes)
    cube->publish();
  const io::EnviReader counts(folder.path() / "counts.img");
  EXPECT_EQ(counts.header().interleave, interleave);
  EXPECT_EQ(counts.header().bands, with_mosaic ? 1 : kChannels);
  std::vector<float> all, line(kWidth);
  for (int y = 0; y < kLines; ++y)
    for (int b = 0; b < counts.header().bands; ++b) {
      counts.read(y, b, line);
      all.insert(all.end(), line.begin(), line.end());
    }
  return all;
}

/// However many channels' 1/f noise is held at once, and however the cube lies.
TEST(DetectionInParts, DrawsTheSame) {
  const std::vector<float> expected = drawn(io::EnviInterleave::bil, false, kMostDriftBytes),
                           through = drawn(io::EnviInterleave::bil, true, kMostDriftBytes);
  const render::ImageInfo image = image_of(true);
  for (int y = 0; y < kLines; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_EQ(
          through[static_cast<std::size_t>(y * kWidth + x)],
          expected[static_cast<std::size_t>((y * kChannels + image.mosaic->channel_at(x, y)) * kWidth + x)]);
  for (const io::EnviInterleave interleave :
       {io::EnviInterleave::bil, io::EnviInterleave::bsq, io::EnviInterleave::bip})
    for (const double channels : {1.0, 2.0}) {
      const double bytes = channels * 4.0 * kWidth * kLines;
      EXPECT_EQ(drawn(interleave, false, bytes), expected) << io::name_of(interleave) << ' ' << channels;
      EXPECT_EQ(drawn(interleave, true, bytes), through) << io::name_of(interleave) << ' ' << channels;
    }
}

}  // namespace
}  // namespace ifov::session::test_detection_parts
