// Other programs read the products: GDAL and SPy through a Python script, and a full disk through a small
// file system.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "io/document/product_words.h"
#include "io/products/geotiff.h"
#include "io/products/part_file.h"
#include "io/products/quicklook.h"
#include "io/small_disk.h"
#include "io/synthetic_image.h"

namespace ifov::io::test_products_rasters {
namespace {

using test::ScratchFolder;
using test::SmallDisk;
using test::SyntheticImage;

struct Outcome {
  int status = 0;
  std::string output;
};

Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), n);
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

/// GDAL's Python module comes with Debian; SPy may live elsewhere: IFOV_TEST_PYTHON names the interpreter that has it.
/// tests/io/check_rasters.py exits with 77 where a module is missing, having said which.
void expect_readable_by(const std::string& reader, double rotation_rad, const std::string& projection) {
  const SyntheticImage image{31, 17, 5};
  const ScratchFolder folder("rasters_" + reader);
  ProductOptions options;
  options.folder = folder.path();
  options.name = "demo";
  options.formats = {&formats::kGeotiff};
  if (why_not_built("png").empty()) options.formats.add(formats::kPng);
  auto info = image.info();
  info.map_rotation_rad = rotation_rad;
  info.map_projection = projection;
  ProductWriter writer(options, image.identity());
  writer.begin(info);
  for (const auto& rect : image.tiles(16)) writer.write(image.tile(rect));
  writer.finish(image.outcome());
  const char* python = reader == "spy" ? std::getenv("IFOV_TEST_PYTHON") : nullptr;
  const Outcome outcome =
      run(format("{} {} {} {} {}", python != nullptr ? python : "/usr/bin/python3",
                 IFOV_SOURCE_DIR "/tests/io/check_rasters.py", reader, folder.path().string(), rotation_rad));
  if (outcome.status == 77) GTEST_SKIP() << outcome.output;
  EXPECT_EQ(outcome.status, 0) << outcome.output;
}

TEST(Rasters, GdalFindsWavelengthsAndPlaces) { expect_readable_by("gdal", 0.0, "Arbitrary"); }
TEST(Rasters, GdalFindsTheRotationOfAMap) { expect_readable_by("gdal", 0.3, "Arbitrary"); }
TEST(Rasters, GdalFindsTheCoordinateSystem) { expect_readable_by("gdal-utm", 0.0, "EPSG:32633"); }
TEST(Rasters, SpyFindsWavelengths) { expect_readable_by("spy", 0.0, "Arbitrary"); }

TEST(Rasters, UnknownCoordinateSystemsAreSaidBeforeTheFirstRay) {
  const SyntheticImage image{4, 4, 1};
  const ScratchFolder folder("projection");
  ProductOptions options;
  options.folder = folder.path();
  auto info = image.info();
  info.map_projection = "Somewhere";
  ProductWriter writer(options, image.identity());
  EXPECT_THROW(writer.begin(info), InputError);
}

std::string error_of(const auto& action) {
  try {
    action();
  } catch (const SystemError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FullDisk, IsSaidBeforeTheFirstRayAndLeavesNothing) {
  const ScratchFolder folder("full1");
  const SmallDisk disk(folder.path(), "size=256k");
  if (!disk.mounted()) GTEST_SKIP() << "a small file system can be mounted by root only";
  const SyntheticImage image{100, 100, 10};
  ProductOptions options;
  options.folder = folder.path();
  ProductWriter writer(options, image.identity());
  const std::string message = error_of([&] { writer.begin(image.info()); });
  EXPECT_EQ(message,
            folder.path().string() + ": the disk is full: the products take 1470.0 kB, 262.1 kB free");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FullDisk, AtTheEndKeepsTheCubes) {
  const ScratchFolder folder("full2");
  const SmallDisk disk(folder.path(), "size=512k");
  if (!disk.mounted()) GTEST_SKIP() << "a small file system can be mounted by root only";
  const SyntheticImage image{50, 50, 10};
  ProductOptions options;
  options.folder = folder.path();
  ProductWriter writer(options, image.identity());
  writer.begin(image.info());
  for (const auto& rect : image.tiles(16)) writer.write(image.tile(rect));
  const std::string message = error_of([&] { writer.finish(image.outcome()); });
  EXPECT_NE(message.find("image_report.html.part: the disk is full: "), std::string::npos) << message;
  EXPECT_NE(message.find("All other products are complete in " + folder.path().string()), std::string::npos)
      << message;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "image_run.json"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "image_radiance.img.hdr"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "image_report.html"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "image_report.html.part"));
}

TEST(FullDisk, WritesNameThePathWhatWasWantedAndWhatIsFree) {
  const ScratchFolder folder("full3");
  const SmallDisk disk(folder.path(), "size=64k");
  if (!disk.mounted()) GTEST_SKIP() << "a small file system can be mounted by root only";
  PartFile file(folder.path() / "x.img");
  const std::string lot(100000, 'x');
  const std::string path = (folder.path() / "x.img.part").string();
  EXPECT_EQ(error_of([&] { file.write_at(0, lot.data(), lot.size()); }),
            path + ": the disk is full: 34.5 kB wanted, 0 bytes free (No space left on device)");
  EXPECT_EQ(error_of([&] { file.reserve(1000000); }),
            path + ": the disk is full: 1000.0 kB wanted, 0 bytes free (No space left on device)");
}

}  // namespace
}  // namespace ifov::io::test_products_rasters
