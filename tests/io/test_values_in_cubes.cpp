#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "io/products/part_file.h"
#include "io/products/product_writer.h"
#include "io/quantities/radiance_quantities.h"
#include "io/run_of_tiles.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/run_state.h"
#include "io/run_state/tile_packs.h"

namespace ifov::io::test_values_in_cubes {
namespace {

using test::expect_same;
using test::kImage;
using test::plan_of;
using test::read_all;
using test::ScratchFolder;
using test::SyntheticImage;
using test::Words;

TEST(TileRecord, MayLeaveItsValuesToTheCubes) {
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  sampling::TileResult tile = kImage.tile(grid[7]);
  const auto split = [&](const std::vector<std::byte>& record, TileHeader& header) {
    std::memcpy(&header, record.data(), sizeof header);
    return std::span(record).subspan(sizeof header);
  };
  TileHeader header;
  tile.drop_variances();
  const auto record = encode_tile(tile, {7, 11, plan.key(), 2.5});
  auto rest = without_values(header, split(record, header));
  EXPECT_LT(rest.size(), record.size() - 8 * tile.mean.size());
  const auto payload = split(rest, header);
  EXPECT_EQ(header.record_bytes(), rest.size());
  EXPECT_EQ(fault_of(header, {plan.key(), kImage.channels, grid}), "");
  sampling::TileResult back;
  const ReadValues give = [&](sampling::TileResult& to, const auto& is_right) {
    EXPECT_FALSE(is_right());
    to.mean = tile.mean, to.half_width = tile.half_width;
    return is_right();
  };
  ASSERT_EQ(decode_tile(header, payload, give, back), "");
  expect_same(tile, back);
  EXPECT_EQ(back.border_share, tile.border_share);
  const ReadValues give_others = [&](sampling::TileResult& to, const auto& is_right) {
    to.mean = tile.mean, to.half_width = tile.half_width;
    to.half_width[5] += 1e-6f;
    return is_right();
  };
  EXPECT_EQ(decode_tile(header, payload, give_others, back), "the values of tile 7 are in the cubes no more");
  EXPECT_EQ(decode_tile(header, payload, {}, back), "the values of tile 7 are in the cubes no more");
  EXPECT_TRUE(without_values(header, payload).empty()) << "they are out already";
}

/// A state and the cubes that hold its values.
struct StateAndCubes {
  StateAndCubes(const std::filesystem::path& folder, const RunPlan& plan, RunStart start,
                LogSink* log = nullptr)
      : products(options_of(plan, folder, start), plan.identity), state(folder, plan, start, log) {
    products.begin(plan.image);
    state.use({[this](sampling::TileResult& tile, const auto& is_right) {
                 return products.read_values(tile, is_right);
               },
               [this] { return products.lines_written(); }});
  }
  static ProductOptions options_of(const RunPlan& plan, const std::filesystem::path& folder, RunStart start) {
    ProductOptions options = plan.products(folder);
    options.go_on = start == RunStart::resume;
    return options;
  }
  /// How many tiles there are, each compared.
  std::size_t read(const RunPlan& plan) {
    std::size_t tiles = 0;
    state.read([&](const sampling::TileResult& tile) {
      sampling::TileResult expected = kImage.tile(tile.tile);
      expected.drop_variances();
      expect_same(tile, expected);
      ++tiles;
    });
    EXPECT_LE(tiles, plan.grid().size());
    return tiles;
  }
  ProductWriter products;
  RunState state;
};

std::uint64_t bytes_of_packs(const std::filesystem::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& pack : packs_in(state_folder(folder) / "tiles")) bytes += std::filesystem::file_size(pack);
  return bytes;
}

void expect_values_held_once(const char* interleave) {
  const ScratchFolder folder("values");
  RunPlan plan = plan_of(kImage);
  plan.formats = {};
  plan.interleave = interleave;
  ASSERT_TRUE(plan.leaves_values_to_cubes());
  const auto grid = plan.grid();
  const auto tile_of = [&](std::size_t k) {
    sampling::TileResult tile = kImage.tile(grid[k]);
    tile.drop_variances();
    return tile;
  };
  {
    StateAndCubes run(folder.path(), plan, RunStart::fresh);
    run.read(plan);
    for (std::size_t k = 0; k + 2 < grid.size(); ++k) {
      run.products.write(tile_of(k));
      run.state.put(static_cast<std::uint32_t>(k), tile_of(k));
    }
    run.state.close();
    EXPECT_GE(run.products.lines_written(), 16);
  }
  const std::uint64_t values = 8u * kImage.channels * kImage.width * kImage.height;
  EXPECT_LT(bytes_of_packs(folder.path()), state_bytes(plan, false) - values / 2);
  EXPECT_LT(state_bytes(plan, true), state_bytes(plan, false));
  {
    StateAndCubes run(folder.path(), plan, RunStart::resume);
    EXPECT_EQ(run.read(plan), grid.size() - 2);
    for (std::size_t k = 0; k < grid.size(); ++k) run.products.write(tile_of(k));
    for (std::size_t k = grid.size() - 2; k < grid.size(); ++k)
      run.state.put(static_cast<std::uint32_t>(k), tile_of(k));
    run.state.close();
    RunOutcome outcome;
    run.products.finish(outcome);
  }
  {  // the cubes were published, as when a time limit has come
    StateAndCubes run(folder.path(), plan, RunStart::resume);
    EXPECT_EQ(run.read(plan), grid.size());
  }
  Words words;
  const std::filesystem::path cube = folder.path() / "image_radiance.img";
  {
    std::fstream file(cube, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(4 * 3);  // pixel 3 of the first line
    file.write("\0\0\0\0", 4);
  }
  StateAndCubes run(folder.path(), plan, RunStart::resume, &words);
  EXPECT_EQ(run.read(plan), grid.size() - 1);
  EXPECT_NE(
      words.text.find("000000.tiles: the values of tile 0 are in the cubes no more: it is computed again"),
      std::string::npos)
      << words.text;
}

TEST(RunState, ValuesThatTheCubesHoldAreNotHeldTwice) { expect_values_held_once("bil"); }
TEST(RunState, NorOfCubesByBand) { expect_values_held_once("bsq"); }
TEST(RunState, NorOfCubesByPixel) { expect_values_held_once("bip"); }

TEST(RunState, AStopWithoutCloseLosesNoTileThatWasPut) {
  const ScratchFolder folder("stopped");
  RunPlan plan = plan_of(kImage);
  plan.formats = {};
  const auto grid = plan.grid();
  std::size_t next = 0;
  for (int start = 0; start < 8; ++start) {
    StateAndCubes run(folder.path(), plan, start == 0 ? RunStart::fresh : RunStart::resume);
    EXPECT_EQ(run.read(plan), next);
    for (std::size_t k = 0; k < std::min(next + 2, grid.size()); ++k) {
      sampling::TileResult tile = kImage.tile(grid[k]);
      tile.drop_variances();
      run.products.write(tile);
      if (k >= next) run.state.put(static_cast<std::uint32_t>(k), tile);
    }
    next = std::min(next + 2, grid.size());  // packs are being written while the state goes
  }
  StateAndCubes run(folder.path(), plan, RunStart::resume);
  EXPECT_EQ(run.read(plan), grid.size());
}

TEST(RunState, TheDiskIsForetoldWithoutValuesHeldTwice) {
  RunPlan plan = plan_of(SyntheticImage{4096, 4096, 210});
  plan.tile_px = 64;
  plan.formats = {};
  const double image = 4.0 * 210 * 4096 * 4096;
  const double products = static_cast<double>(product_bytes(plan).all());
  EXPECT_LE((products + static_cast<double>(state_bytes(plan, true))) / image, 2.2);
  EXPECT_GT((products + static_cast<double>(state_bytes(plan, false))) / image, 4.0);
  plan.cubes.add(quantities::kStandardError);
  EXPECT_FALSE(plan.leaves_values_to_cubes()) << "variances lie in no cube";
  EXPECT_EQ(state_bytes(plan, true), state_bytes(plan, false));
}

TEST(PartFile, IsGoneOnWithOnlyWhereNobodyElseHasIt) {
  const ScratchFolder folder("go_on");
  const std::filesystem::path path = folder.path() / "cube.img", part = folder.path() / "cube.img.part",
                              other = folder.path() / "of_somebody";
  std::ofstream(part) << "0123456789";
  {
    PartFile file(path, PartFile::Left::go_on);
    file.reserve(8);
    file.write_at(2, "xy", 2);
    file.discard();  // an earlier start has begun it
  }
  EXPECT_EQ(read_all(part), "01xy4567");
  std::filesystem::create_hard_link(part, other);
  {
    PartFile file(path, PartFile::Left::go_on);
    file.write_at(0, "ab", 2);
  }
  EXPECT_EQ(read_all(other), "01xy4567");
  EXPECT_EQ(read_all(part), "ab");
  std::filesystem::remove(part);
  std::filesystem::create_symlink(other, part);
  { PartFile file(path, PartFile::Left::go_on); }
  EXPECT_EQ(read_all(other), "01xy4567");
  EXPECT_FALSE(std::filesystem::is_symlink(part));
}

}  // namespace
}  // namespace ifov::io::test_values_in_cubes
