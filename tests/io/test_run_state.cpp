#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "io/quantities/location_quantities.h"
#include "io/quantities/radiance_quantities.h"
#include "io/run_of_tiles.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/run_state.h"
#include "io/run_state/tile_packs.h"

namespace ifov::io::test_run_state {
namespace {

using test::expect_same;
using test::kImage;
using test::message_of;
using test::plan_of;
using test::read_all;
using test::ScratchFolder;
using test::Words;

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
    tile.pilot_samples = 3, tile.probe_samples = 4, tile.rays.continuation = 5;
    const auto record = encode_tile(tile, {7, 11, plan.key(), 2.5});
    TileHeader header;
    std::memcpy(&header, record.data(), sizeof header);
    EXPECT_EQ(header.record_bytes(), record.size());
    EXPECT_EQ(fault_of(header, {plan.key(), kImage.channels, grid}), "");
    sampling::TileResult back;
    ASSERT_EQ(decode_tile(header, std::span(record).subspan(sizeof header), {}, back), "");
    expect_same(tile, back);
    EXPECT_EQ(back.pilot_samples + back.probe_samples, 7u);
  }
}

TEST(TileRecord, HoldsLayersAndLeavesVariancesOut) {
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  sampling::TileResult tile = kImage.tile(grid[7]);
  tile.drop_variances();
  EXPECT_FLOAT_EQ(tile.share_of_borders(0), 0.75f);
  const std::uint64_t pixels = tile.samples.size();
  for (const bool noted : {false, true}) {
    const std::vector<double> values(3 * pixels, 0.1), others(pixels, 0.2);
    const std::uint64_t before = tile.bytes();
    if (noted) {
      tile.layers = {test::layer_of("location", 3, values), test::layer_of("nobody's", 1, others)};
      EXPECT_EQ(tile.bytes(), before + 4 * 8 * pixels);
    }
    const auto record = encode_tile(tile, {7, 11, plan.key(), 2.5});
    EXPECT_EQ(record.size(), frame_bytes(tile) + tile.bytes());
    TileHeader header;
    std::memcpy(&header, record.data(), sizeof header);
    EXPECT_EQ(fault_of(header, {plan.key(), kImage.channels, grid}), "");
    sampling::TileResult back;
    ASSERT_EQ(decode_tile(header, std::span(record).subspan(sizeof header), {}, back), "");
    expect_same(tile, back);
    EXPECT_EQ(back.border_share, tile.border_share);
    EXPECT_EQ(back.layers.size(), noted ? 2u : 0u);
  }
}

TEST(RunPlan, KeepsWhatProductsSayOfTheAcquisition) {
  RunPlan plan = plan_of(kImage);
  plan.name = "flight_1";
  plan.cubes = {&quantities::kHalfWidth, &quantities::kLocation};
  plan.interleave = "bip";
  Acquisition& a = plan.identity.acquisition;
  a.time = "2024-06-21T10:30:00.000Z";
  a.light = {35.0, 140.0, false};
  a.origin = {49.4, 8.7};
  a.origin_height_m = 110.0;
  a.origin_on_map_m = {477000.0, 5474000.0, 110.0};
  a.camera.model = "frame";
  a.camera.focal_length_m = 0.05;
  a.camera.position_m = {1.0, 2.0, 3.0};
  a.footprint = {std::nullopt, Acquisition::Corner{{4.0, 5.0, 6.0}, Acquisition::Position{49.0, 8.0}}};
  const RunPlan back = plan_in(to_json(plan), "state.json");
  EXPECT_EQ(to_json(back), to_json(plan));
  EXPECT_EQ(back.identity.acquisition.camera.position_m->z, 3.0);
  EXPECT_EQ(back.name, "flight_1");
  EXPECT_EQ(back.interleave, "bip");
  EXPECT_TRUE(back.cubes == plan.cubes);
  EXPECT_EQ(back.identity.acquisition.light->azimuth_deg, 140.0);
  EXPECT_FALSE(back.identity.acquisition.footprint[0]);
  EXPECT_EQ(back.identity.acquisition.footprint[1]->position->longitude_deg, 8.0);
}

TEST(TileRecord, ListsThatPromiseTooMuchAreRefused) {
  const RunPlan plan = plan_of(kImage);
  const auto grid = plan.grid();
  const auto record = encode_tile(kImage.tile(grid[0]), {0, 11, plan.key(), 2.5});
  constexpr std::size_t kValueBytes = 32, kBands = 36, kCount = 40;  // of an entry of the list
  const auto fault = [&](std::size_t at, std::uint64_t number, std::size_t bytes) {
    auto changed = record;
    std::memcpy(changed.data() + sizeof(TileHeader) + at, &number, bytes);
    TileHeader header;
    std::memcpy(&header, changed.data(), sizeof header);
    const std::size_t list = 48 * std::size_t{header.arrays};
    header.list_hash = XXH3_64bits(changed.data() + sizeof header, list);  // as a stranger would
    sampling::TileResult back;
    return decode_tile(header, std::span(changed).subspan(sizeof header), {}, back);
  };
  EXPECT_EQ(fault(kCount, kImage.tile(grid[0]).mean.size(), 8), "") << "nothing is changed";
  for (const std::uint64_t count : {std::uint64_t{1} << 37, std::uint64_t{1} << 62, ~std::uint64_t{0}})
    EXPECT_EQ(fault(kCount, count, 8), "the checksum of tile 0 is wrong");
  EXPECT_EQ(fault(kCount, 3, 8), "the checksum of tile 0 is wrong");
  EXPECT_EQ(fault(kValueBytes, 1 << 30, 4), "the checksum of tile 0 is wrong");
  EXPECT_NE(fault(kValueBytes, 8, 4), "");
  EXPECT_NE(fault(kBands, 2, 4), "") << "the mean as a layer";
  EXPECT_NE(fault(0, 'x', 1), "") << "xean";
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

/// The viewer takes the plan for a sign that a run is not done: it would draw one that has lost its tiles.
TEST(RunState, ThePlanGoesBeforeTheTiles) {
  const ScratchFolder folder("removed");
  const RunPlan plan = plan_of(kImage);
  fill(folder.path(), plan);
  RunState state(folder.path(), plan, RunStart::resume, nullptr);
  state.read([](const auto&) {});
  const int events = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  ASSERT_GE(events, 0);
  ASSERT_GE(inotify_add_watch(events, state_folder(folder.path()).c_str(), IN_DELETE), 0);
  ASSERT_GE(inotify_add_watch(events, (state_folder(folder.path()) / "tiles").c_str(), IN_DELETE), 0);
  state.remove();
  alignas(inotify_event) char buffer[4096];
  ASSERT_GT(read(events, buffer, sizeof buffer), 0);
  close(events);
  EXPECT_EQ(std::string(reinterpret_cast<const inotify_event*>(buffer)->name),
            plan_file(folder.path()).filename());
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
  EXPECT_EQ(words,
            format("warning: {}: the checksum of tile 0 is wrong: it is computed again\n", pack.string()));
  EXPECT_EQ(resume(read_all(pack), words), tiles - 1) << "the whole tiles stay in the file";
  EXPECT_EQ(words, "");

  EXPECT_EQ(resume(whole.substr(0, whole.size() - 1), words), tiles - 1);
  EXPECT_EQ(words, format("warning: {}: the file is cut short: tile {} is computed again\n", pack.string(),
                          tiles - 1));
  EXPECT_EQ(resume(whole.substr(0, sizeof(TileHeader) - 1), words), 0u);
  EXPECT_EQ(words,
            format("warning: {}: the file is cut short: its last tile is computed again\n", pack.string()));
  EXPECT_FALSE(std::filesystem::exists(pack)) << "nothing in it is whole";
  EXPECT_EQ(resume("", words), 0u);
  EXPECT_EQ(words, format("warning: {}: the file is empty: its tiles are computed again\n", pack.string()));
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
    EXPECT_EQ(message_of<SystemError>([&] { RunLock(file, nullptr); }),
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
  EXPECT_EQ(message_of<SystemError>([&] { RunLock(file, nullptr); }),
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
    const std::string message = message_of<SystemError>([&] { same = to_json(read_plan(file)); });
    if (same == whole) continue;  // a digit beyond what a number holds
    EXPECT_TRUE(message == damaged || message.find("it is of format") != std::string::npos)
        << at << ' ' << message;
  }
  std::ofstream(file, std::ios::trunc) << whole.substr(0, whole.size() / 2);
  EXPECT_EQ(message_of<SystemError>([&] { read_plan(file); }), damaged);
}

}  // namespace
}  // namespace ifov::io::test_run_state
