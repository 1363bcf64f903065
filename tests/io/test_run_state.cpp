#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "io/products/part_file.h"
#include "io/run_state/run_state.h"
#include "io/run_state/tile_packs.h"
#include "io/synthetic_image.h"

namespace ifov::io {
namespace {

using test::read_all;
using test::ScratchFolder;
using test::SyntheticImage;

constexpr int kTile_px = 8;
const SyntheticImage kImage{37, 23, 5};

RunPlan plan_of(const SyntheticImage& image) {
  RunPlan plan;
  plan.identity = image.identity();
  plan.build = "0123456789abcdef (glibc 2.36)";
  plan.instruction_set = "x86-64-v3";
  plan.files = {{"city.ply", 100, 7, {1, 2}}, {"spectra/grass.txt", 20, 8, {3, 4}}};
  plan.image = image.info();
  plan.image.map_x_m = 0.1 + 0.2;  // needs all its digits
  plan.tile_px = kTile_px;
  plan.judged = plan.knows_errors = true;
  plan.notes = {"floor of the accuracy: \"0.001\""};
  plan.geotiff = plan.report = true;
  plan.quicklook_channels = {4, 2, 0};
  return plan;
}

/// What was said.
class Words final : public LogSink {
 public:
  void info(const std::string& message) override { text += "info: " + message + "\n"; }
  void warn(const std::string& message) override { text += "warning: " + message + "\n"; }
  std::string text;
};

template <class Error, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void expect_same(const sampling::TileResult& a, const sampling::TileResult& b) {
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.variance_geometry, b.variance_geometry);
  EXPECT_EQ(a.variance_path, b.variance_path);
  EXPECT_EQ(a.half_width, b.half_width);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.label_rays, b.label_rays);
  EXPECT_EQ(a.radiance_evaluations, b.radiance_evaluations);
  EXPECT_EQ(a.reasons, b.reasons);
  EXPECT_EQ(a.worst_ratio, b.worst_ratio);
  EXPECT_EQ(a.missable_fraction, b.missable_fraction);
  ASSERT_EQ(a.abundances.size(), b.abundances.size());
  EXPECT_EQ(std::memcmp(a.abundances.data(), b.abundances.data(),
                        a.abundances.size() * sizeof(sampling::Abundance)),
            0);
  EXPECT_EQ(a.halo_samples, b.halo_samples);
  EXPECT_EQ(a.rays.primary, b.rays.primary);
  EXPECT_EQ(a.rays.shadow, b.rays.shadow);
  EXPECT_EQ(a.rays.bounce, b.rays.bounce);
}

/// All tiles of the image into a new state, and no further.
void fill(const std::filesystem::path& folder, const RunPlan& plan, std::size_t most = 1000) {
  RunState state(folder, plan, RunStart::fresh, nullptr);
  state.read([](const auto&) {});
  const auto grid = plan.grid();
  for (std::size_t k = 0; k < std::min(most, grid.size()); ++k)
    state.put(static_cast<std::uint32_t>(k), kImage.tile(grid[k]));
  state.close();
}

/// The tiles of the state in one pack: on a slow machine they were finished too far apart to share one.
std::filesystem::path only_pack(const std::filesystem::path& state) {
  const auto packs = packs_in(state / "tiles");
  std::ofstream first(packs.at(0), std::ios::binary | std::ios::app);
  for (std::size_t k = 1; k < packs.size(); ++k) {
    first << read_all(packs[k]);
    std::filesystem::remove(packs[k]);
  }
  return packs[0];
}

TEST(TileRecord, HoldsAllOfATile) {
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  for (const bool with_errors : {true, false}) {
    sampling::TileResult tile = kImage.tile(grid[7]);
    if (!with_errors) tile.variance_geometry = tile.variance_path = tile.half_width = {};
    tile.seed_samples = 3, tile.probe_samples = 4, tile.rays.bounce = 5;
    const auto record = encode_tile(tile, {7, 11, plan.key(), 2.5});
    TileHeader header;
    std::memcpy(&header, record.data(), sizeof header);
    EXPECT_EQ(header.record_bytes(), record.size());
    EXPECT_EQ(fault_of(header, {plan.key(), kImage.channels, grid}), "");
    sampling::TileResult back;
    ASSERT_EQ(decode_tile(header, std::span(record).subspan(sizeof header), {}, back), "");
    expect_same(tile, back);
    EXPECT_EQ(back.seed_samples + back.probe_samples, 7u);
  }
}

TEST(TileRecord, HoldsPlacesAndLeavesVariancesOut) {
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  sampling::TileResult tile = kImage.tile(grid[7]);
  const std::size_t whole = encode_tile(tile, {7, 11, plan.key(), 2.5}).size();
  tile.drop_variances();
  EXPECT_FLOAT_EQ(tile.share_of_borders(0), 0.75f);
  for (const bool placed : {false, true}) {
    if (placed) tile.position_m.assign(3 * tile.samples.size(), 0.1);
    const auto record = encode_tile(tile, {7, 11, plan.key(), 2.5});
    EXPECT_EQ(record.size(), whole - 4 * (2 * tile.mean.size() - tile.samples.size()) + (placed ? 24 : 0) * tile.samples.size());
    TileHeader header;
    std::memcpy(&header, record.data(), sizeof header);
    EXPECT_EQ(fault_of(header, {plan.key(), kImage.channels, grid}), "");
    sampling::TileResult back;
    ASSERT_EQ(decode_tile(header, std::span(record).subspan(sizeof header), {}, back), "");
    expect_same(tile, back);
    EXPECT_EQ(back.border_share, tile.border_share);
    EXPECT_EQ(back.position_m, tile.position_m);
  }
}

TEST(RunPlan, KeepsWhatProductsSayOfTheAcquisition) {
  RunPlan plan = plan_of(kImage);
  plan.name = "flight_1";
  plan.cubes = {Product::half_width, Product::location};
  Acquisition& a = plan.identity.acquisition;
  a.time = "2024-06-21T10:30:00.000Z";
  a.light = {35.0, 140.0, false};
  a.origin = {49.4, 8.7};
  a.origin_height_m = 110.0;
  a.origin_on_map_m = {477000.0, 5474000.0, 110.0};
  a.camera.is_frame = true;
  a.camera.position_m = {1.0, 2.0, 3.0};
  a.footprint = {std::nullopt, Acquisition::Corner{{4.0, 5.0, 6.0}, Acquisition::Place{49.0, 8.0}}};
  const RunPlan back = plan_in(to_json(plan), "state.json");
  EXPECT_EQ(to_json(back), to_json(plan));
  EXPECT_EQ(back.name, "flight_1");
  EXPECT_TRUE(back.cubes == plan.cubes);
  EXPECT_EQ(back.identity.acquisition.light->azimuth_deg, 140.0);
  EXPECT_FALSE(back.identity.acquisition.footprint[0]);
  EXPECT_EQ(back.identity.acquisition.footprint[1]->place->longitude_deg, 8.0);
}

TEST(TileRecord, AnyFlippedBitIsNoticed) {
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  auto record = encode_tile(kImage.tile(grid[0]), {0, 11, plan.key(), 2.5});
  for (std::size_t byte = 0; byte < record.size(); byte += byte < sizeof(TileHeader) ? 1 : 37) {
    for (int bit = 0; bit < 8; bit += 3) {
      record[byte] ^= std::byte{static_cast<unsigned char>(1 << bit)};
      TileHeader header;
      std::memcpy(&header, record.data(), sizeof header);
      sampling::TileResult back;
      EXPECT_FALSE(fault_of(header, {plan.key(), kImage.channels, grid}).empty() &&
                   decode_tile(header, std::span(record).subspan(sizeof header), {}, back).empty())
          << byte;
      record[byte] ^= std::byte{static_cast<unsigned char>(1 << bit)};
    }
  }
}

TEST(TileRecord, MayLeaveItsValuesToTheCubes) {
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  sampling::TileResult tile = kImage.tile(grid[7]);
  const auto split = [&](const std::vector<std::byte>& record, TileHeader& header) {
    std::memcpy(&header, record.data(), sizeof header);
    return std::span(record).subspan(sizeof header);
  };
  TileHeader header;
  auto record = encode_tile(tile, {7, 11, plan.key(), 2.5});
  EXPECT_TRUE(without_values(header, split(record, header)).empty()) << "no cube holds variances";

  tile.drop_variances();
  record = encode_tile(tile, {7, 11, plan.key(), 2.5});
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
  StateAndCubes(const std::filesystem::path& folder, const RunPlan& plan, RunStart start, LogSink* log = nullptr)
      : products(options_of(plan, folder, start), plan.identity), state(folder, plan, start, log) {
    products.begin(plan.image);
    state.use({[this](sampling::TileResult& tile, const auto& is_right) { return products.read_values(tile, is_right); },
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

TEST(RunState, ValuesThatTheCubesHoldAreNotHeldTwice) {
  const ScratchFolder folder("values");
  RunPlan plan = plan_of(kImage);
  plan.geotiff = plan.report = false;
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
    for (std::size_t k = grid.size() - 2; k < grid.size(); ++k) run.state.put(static_cast<std::uint32_t>(k), tile_of(k));
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
  EXPECT_NE(words.text.find("000000.tiles: the values of tile 0 are in the cubes no more: it is computed again"),
            std::string::npos)
      << words.text;
}

TEST(RunState, AStopWithoutCloseLosesNoTileThatWasPut) {
  const ScratchFolder folder("stopped");
  RunPlan plan = plan_of(kImage);
  plan.geotiff = plan.report = false;
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
  plan.geotiff = false;
  const double image = 4.0 * 210 * 4096 * 4096;
  const double products = static_cast<double>(product_bytes(plan).all());
  EXPECT_LE((products + static_cast<double>(state_bytes(plan, true))) / image, 2.2);
  EXPECT_GT((products + static_cast<double>(state_bytes(plan, false))) / image, 4.0);
  plan.cubes.add(Product::standard_error);
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

TEST(RunState, GivesBackEveryTileOnce) {
  const ScratchFolder folder("state");
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  {
    RunState state(folder.path(), plan, RunStart::fresh, nullptr);
    state.read([](const auto&) { FAIL() << "there are no tiles yet"; });
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> workers;
    for (int t = 0; t < 4; ++t)
      workers.emplace_back([&] {
        for (std::size_t k; (k = next++) < grid.size();)
          state.put(static_cast<std::uint32_t>(k), kImage.tile(grid[k]));
      });
    for (auto& worker : workers) worker.join();
    state.put(3, kImage.tile(grid[3]));  // once more
    state.close();
  }
  Words words;
  RunState state(folder.path(), plan, RunStart::resume, &words);
  std::size_t taken = 0;
  const TilesDone tiles = state.read([&](const sampling::TileResult& tile) {
    ++taken;
    expect_same(tile, kImage.tile(tile.tile));
  });
  EXPECT_EQ(taken, grid.size());
  EXPECT_EQ(tiles.count(), grid.size());
  EXPECT_EQ(tiles.pixels, 37 * 23);
  EXPECT_EQ(words.text, "");
  state.remove();
  EXPECT_FALSE(std::filesystem::exists(state_folder(folder.path())));
}

TEST(RunState, ADamagedTileIsToldAndComputedAgain) {
  const ScratchFolder folder("damage");
  const RunPlan plan = plan_of(kImage);
  const std::size_t tiles = plan.grid().size();
  fill(folder.path(), plan);
  const std::filesystem::path pack = only_pack(state_folder(folder.path()));
  const std::string whole = read_all(pack);
  const auto resume = [&](const std::string& content, std::string& words) {
    std::ofstream(pack, std::ios::binary) << content;
    Words log;
    RunState state(folder.path(), plan, RunStart::resume, &log);
    std::size_t taken = 0;
    state.read([&](const sampling::TileResult& tile) {
      ++taken;
      expect_same(tile, kImage.tile(tile.tile));
    });
    words = log.text;
    return taken;
  };
  std::string words;
  EXPECT_EQ(resume(whole, words), tiles);
  EXPECT_EQ(words, "");

  std::string flipped = whole;
  flipped[sizeof(TileHeader) + 100] ^= 16;  // in the first tile's values
  EXPECT_EQ(resume(flipped, words), tiles - 1);
  EXPECT_EQ(words, format("warning: {}: the checksum of tile 0 is wrong: it is computed again\n",
                          pack.string()));
  EXPECT_EQ(resume(read_all(pack), words), tiles - 1) << "the whole tiles stay in the file";
  EXPECT_EQ(words, "");

  EXPECT_EQ(resume(whole.substr(0, whole.size() - 1), words), tiles - 1);
  EXPECT_EQ(words, format("warning: {}: the file is cut short: tile {} is computed again\n",
                          pack.string(), tiles - 1));
  EXPECT_EQ(resume(whole.substr(0, sizeof(TileHeader) - 1), words), 0u);
  EXPECT_EQ(words, format("warning: {}: the file is cut short: its last tile is computed again\n",
                          pack.string()));
  EXPECT_FALSE(std::filesystem::exists(pack)) << "nothing in it is whole";
  EXPECT_EQ(resume("", words), 0u);
  EXPECT_EQ(words,
            format("warning: {}: the file is empty: its tiles are computed again\n", pack.string()));
  flipped = whole;
  flipped[40] ^= 1;  // a size in the first header: what follows cannot be found
  EXPECT_EQ(resume(flipped, words), 0u);
  EXPECT_EQ(
      words,
      format("warning: {}: a tile is not taken, its header is damaged: it and what follows it in the file "
             "is computed again\n",
             pack.string()));
}

TEST(RunState, NothingFinishedIsThrownAwayUnasked) {
  const ScratchFolder folder("unasked");
  const RunPlan plan = plan_of(kImage);
  fill(folder.path(), plan, 4);
  EXPECT_EQ(message_of<InputError>([&] { RunState(folder.path(), plan, RunStart::fresh, nullptr); }),
            format("{}: this folder holds an unfinished run, 4 of 15 tiles are done. Go on with it "
                   "(--resume), throw it "
                   "away and start anew (--restart), or take another folder (--output).",
                   folder.path().string()));
  EXPECT_EQ(survey_tiles(folder.path(), plan).count(), 4u);
  {
    RunState state(folder.path(), plan, RunStart::restart, nullptr);
    EXPECT_EQ(state.read([](const auto&) {}).count(), 0u);
  }
  EXPECT_EQ(message_of<InputError>([&] { RunState(folder.path(), plan, RunStart::fresh, nullptr); }),
            "no error");
}

TEST(RunState, WhatHasChangedIsNamed) {
  const ScratchFolder folder("changed");
  const RunPlan plan = plan_of(kImage);
  fill(folder.path(), plan, 4);
  const auto resumed_as = [&](const auto& change) {
    RunPlan other = plan;
    change(other);
    return message_of<InputError>([&] { RunState(folder.path(), other, RunStart::resume, nullptr); });
  };
  const auto message = [&](const std::string& lines) {
    return format(
        "{}: the run cannot go on, because its tiles would not fit together:\n{}\nPut back what has changed "
        "and resume; or keep the 4 of 15 tiles that are done and render into another folder (--output); or "
        "throw them away and start anew (--restart).",
        folder.path().string(), lines);
  };
  EXPECT_EQ(resumed_as([](RunPlan&) {}), "no error");
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.identity.document_path = "elsewhere/demo.json"; }), "no error");
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.files[0].time_ns = 99; }), "no error");
  EXPECT_EQ(resumed_as([](RunPlan& p) {
              const auto at = p.identity.document_text.find("accuracy");
              p.identity.document_text.replace(at, 8, "grid");
            }),
            message("  the document: line 3 was '\"sampler\": \"accuracy\"' and is '\"sampler\": \"grid\"'"));
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.identity.document_text += "// more\n"; }),
            message("  the document: line 5 is new: '// more'"));
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.identity.seed = 43; }), message("  the seed was 42 and is 43"));
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.files[1].hash[0] = 9; }),
            message("  the scene's file 'spectra/grass.txt' has other bytes"));
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.files[0].bytes = 99; }),
            message("  the scene's file 'city.ply' had 100 bytes and has 99"));
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.files.pop_back(); }),
            message("  the scene's file 'spectra/grass.txt' is gone"));
  EXPECT_EQ(resumed_as([](RunPlan& p) {
              p.files.push_back({"a.hdr", 1, 1, {}});
            }),
            message("  the scene's file 'a.hdr' is new"));
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.identity.version = "0.2.0"; }),
            message("  the program was ifov 0.1.0 and is ifov 0.2.0"));
  EXPECT_EQ(resumed_as([](RunPlan& p) { p.build = "fedc"; }),
            message("  the program was build 0123456789abcdef (glibc 2.36) and is build fedc of ifov 0.1.0"));
  EXPECT_EQ(resumed_as([](RunPlan& p) {
              p.instruction_set = "x86-64-v4";
              p.identity.seed = 1;
            }),
            message("  the seed was 42 and is 1\n  the instruction set was x86-64-v3 and is x86-64-v4"));
}

TEST(RunState, TilesOfAnotherRunAreNotTaken) {
  const ScratchFolder folder("other"), other_folder("other2");
  const RunPlan plan = plan_of(kImage);
  RunPlan other = plan;
  other.identity.document_text += " ";
  fill(folder.path(), plan, 4);
  fill(other_folder.path(), other, 5);
  const auto from = packs_in(state_folder(other_folder.path()) / "tiles").at(0);
  std::filesystem::copy_file(from, state_folder(folder.path()) / "tiles" / "000777.tiles");
  Words words;
  RunState state(folder.path(), plan, RunStart::resume, &words);
  EXPECT_EQ(state.read([](const auto&) {}).count(), 4u);
  EXPECT_NE(words.text.find("a tile is not taken, it belongs to another run"), std::string::npos)
      << words.text;
}

TEST(RunLock, TwoRunsDoNotMeet) {
  const ScratchFolder folder("lock");
  const auto file = folder.path() / "lock";
  char host[256] = {};
  ASSERT_EQ(gethostname(host, sizeof host - 1), 0);
  {
    const RunLock lock(file, nullptr);
    EXPECT_EQ(lock_holder(file), format("process {} on {}", getpid(), host));
    EXPECT_EQ(message_of<EnvironmentError>([&] { RunLock(file, nullptr); }),
              format("{}: another run is at work in this folder: process {} on {}; wait for it, stop it, or "
                     "take another "
                     "folder (--output)",
                     folder.path().string(), getpid(), host));
  }
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(lock_holder(file), "");
}

TEST(RunLock, ADeadProcessLosesIt) {
  const ScratchFolder folder("stale");
  const auto file = folder.path() / "lock";
  const pid_t child = fork();
  if (child == 0) _exit(0);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  char host[256] = {};
  ASSERT_EQ(gethostname(host, sizeof host - 1), 0);
  std::ofstream(file) << child << ' ' << host << '\n';
  EXPECT_EQ(lock_holder(file), "");
  Words words;
  { const RunLock lock(file, &words); }
  EXPECT_EQ(words.text,
            format("warning: {}: process {}, which was at work here, is gone: its lock is taken over\n",
                   folder.path().string(), child));

  std::ofstream(file) << "4711 another-host\n";
  EXPECT_EQ(lock_holder(file), "process 4711 on another-host");
  EXPECT_EQ(message_of<EnvironmentError>([&] { RunLock(file, nullptr); }),
            format("{}: a run on another machine, process 4711 on another-host, has not ended or was killed; "
                   "where it is "
                   "gone, delete {} and try again",
                   folder.path().string(), file.string()));
}

TEST(RunPlan, ReadsAsItWasWritten) {
  const ScratchFolder folder("plan");
  const RunPlan plan = plan_of(kImage);
  const auto file = folder.path() / "state.json";
  std::ofstream(file) << to_json(plan);
  const RunPlan back = read_plan(file);
  EXPECT_EQ(to_json(back), to_json(plan));
  EXPECT_EQ(back.image.map_x_m, 0.1 + 0.2);
  EXPECT_EQ(back.key(), plan.key());
  EXPECT_EQ(differences(plan, back), std::vector<std::string>());
}

TEST(RunPlan, DamageIsNoticed) {
  const ScratchFolder folder("plan_damage");
  const auto file = folder.path() / "state.json";
  const std::string whole = to_json(plan_of(kImage));
  const std::string damaged = format(
      "{}: it is damaged; what it belongs to cannot be known, so its tiles cannot be used: start anew with "
      "--restart",
      file.string());
  for (std::size_t at = 0; at + 2 < whole.size(); at += 13) {
    std::string text = whole;
    text[at] ^= 1;
    if (text[at] == '\n' || text[at] == '\v' || text[at] == '!')
      continue;  // white space that became other space
    std::ofstream(file, std::ios::trunc) << text;
    std::string same;
    const std::string message = message_of<EnvironmentError>([&] { same = to_json(read_plan(file)); });
    if (same == whole) continue;  // a digit beyond what a number holds
    EXPECT_TRUE(message == damaged || message.find("it is of format") != std::string::npos)
        << at << ' ' << message;
  }
  std::ofstream(file, std::ios::trunc) << whole.substr(0, whole.size() / 2);
  EXPECT_EQ(message_of<EnvironmentError>([&] { read_plan(file); }), damaged);
}

}  // namespace
}  // namespace ifov::io
