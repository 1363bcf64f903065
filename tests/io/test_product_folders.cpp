#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include "core/error.h"
#include "io/products/part_file.h"
#include "io/written_image.h"

namespace ifov::io::test_product_folders {
namespace {

using namespace written_image;

TEST(ProductWriter, StoppingLeavesPartFilesWithTheFinishedTiles) {
  const SyntheticImage image{40, 40, 3};
  const ScratchFolder folder("stopped");
  {
    ProductWriter writer(options_in(folder.path()), image.identity());
    writer.begin(image.info());
    writer.write(image.tile({16, 16, 32, 32}));
    EXPECT_THROW(writer.finish(image.outcome()), std::logic_error);
    EXPECT_EQ(writer.part_files().size(), 19u);
  }
  for (const auto& name : names_in(folder.path())) EXPECT_TRUE(name.ends_with(".part")) << name;
  const std::string bytes = test::read_all(folder.path() / "demo_radiance.img.part");
  ASSERT_EQ(bytes.size(), 4u * 40 * 40 * 3);
  float value = 0.0f;
  std::memcpy(&value, bytes.data() + 4 * ((20 * 3 + 1) * 40 + 25), 4);
  EXPECT_EQ(value, image.radiance(25, 20, 1));
}

TEST(ProductWriter, AnEarlierRunStaysUntilTheNewOneIsWhole) {
  const SyntheticImage image{10, 10, 2};
  const ScratchFolder folder("earlier");
  write_image(image, options_in(folder.path()), image.tiles(16));
  {
    const SyntheticImage other{12, 12, 3};
    ProductWriter writer(options_in(folder.path()), other.identity());
    writer.begin(other.info());
    writer.write(other.tile({0, 0, 12, 6}));
  }
  expect_all_cubes(image, folder.path());
}

TEST(ProductWriter, TwoRunsOfOneNameExcludeEachOther) {
  const SyntheticImage image{10, 10, 2};
  const ScratchFolder folder("twice");
  ProductWriter first(options_in(folder.path()), image.identity());
  first.begin(image.info());
  ProductWriter second(options_in(folder.path()), image.identity());
  try {
    second.begin(image.info());
    FAIL() << "no error";
  } catch (const SystemError& error) {
    EXPECT_NE(std::string(error.what()).find("another run is writing this file"), std::string::npos)
        << error.what();
  }
  first.write(image.tile({0, 0, 10, 10}));
  first.finish(image.outcome());
  expect_all_cubes(image, folder.path());
}

TEST(ProductWriter, UnusableFoldersAreSaid) {
  const SyntheticImage image{10, 10, 2};
  const ScratchFolder folder("unusable");
  test::read_all(folder.path());
  std::ofstream(folder.path() / "file") << "not a folder";
  ProductWriter writer(options_in(folder.path() / "file"), image.identity());
  try {
    writer.begin(image.info());
    FAIL() << "no error";
  } catch (const SystemError& error) {
    EXPECT_NE(std::string(error.what()).find((folder.path() / "file").string()), std::string::npos)
        << error.what();
  }
}

TEST(ProductWriter, MorePixelsThanTheDiskHoldsAreRefusedBeforeTheFirstRay) {
  SyntheticImage image{1000000, 1000000, 3};
  const ScratchFolder folder("huge");
  ProductWriter writer(options_in(folder.path()), image.identity());
  try {
    writer.begin(image.info());
    FAIL() << "no error";
  } catch (const SystemError& error) {
    EXPECT_NE(std::string(error.what()).find("the disk is full: the products take"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(PartFile, DiscardingClosesAndRemoves) {
  const ScratchFolder folder("discard");
  PartFile file(folder.path() / "image.bin");
  write_part(file, "light");
  const auto open_here = [&] {
    int count = 0;
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
      count += std::filesystem::read_symlink(entry, gone).string().starts_with(file.part_path().string());
    return count;
  };
  EXPECT_GT(open_here(), 0);
  file.discard();
  EXPECT_EQ(open_here(), 0);
  EXPECT_FALSE(std::filesystem::exists(file.part_path()));
}

}  // namespace
}  // namespace ifov::io::test_product_folders
