#include <chrono>
#include <optional>
#include <thread>

#include "facade_fixture.h"

namespace facade_test::test_threads {
namespace {

TEST_F(Facade, ASinkThatThrowsEndsTheRun) {
  class Broken final : public ifov::TileSink {
    void write(const ifov::Tile&) override { throw std::runtime_error("no more room here"); }
  } broken;
  try {
    ifov::Simulation::load(scene()).render_tiles(broken);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no more room here");
  }
}

TEST_F(Facade, IsStoppedFromAnotherThread) {
  const ifov::Simulation simulation =
      ifov::Simulation::load(ifov::Document::parse(endless(), "scene.json", folder_));
  const auto stop_soon = [&](const auto& work) {
    ifov::CancelToken cancel;
    std::thread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      cancel.cancel();
    });
    const auto begin = std::chrono::steady_clock::now();
    try {
      work(cancel);
      ADD_FAILURE() << "it was not stopped";
    } catch (const ifov::Cancelled& stop) {
      EXPECT_EQ(ifov::exit_code_of(stop), 130);
    }
    other.join();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  };
  stop_soon([&](const ifov::CancelToken& cancel) {
    simulation.render({.folder = folder_ / "out", .anyway = true, .cancel = &cancel});
  });
  for (const auto& entry : fs::directory_iterator(folder_ / "out"))
    EXPECT_EQ(entry.path().extension(), ".part") << entry.path();
  Cube cube;
  stop_soon([&](const ifov::CancelToken& cancel) { simulation.render_tiles(cube, {.cancel = &cancel}); });
}

TEST_F(Facade, TwoRunsDoNotShareAFolder) {
  const ifov::Simulation simulation =
      ifov::Simulation::load(ifov::Document::parse(endless(), "scene.json", folder_));
  ifov::CancelToken cancel;
  std::thread first([&] {
    EXPECT_THROW(simulation.render({.folder = folder_ / "out", .anyway = true, .cancel = &cancel}),
                 ifov::Cancelled);
  });
  while (!fs::exists(folder_ / "out" / "run.part" / "state.json"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_THROW(
      simulation.render({.folder = folder_ / "out", .start = ifov::RunStart::resume, .anyway = true}),
      ifov::SystemError);
  cancel.cancel();
  first.join();
}

/// Two scenes, one of them under modelled air, are loaded and rendered at once, again and again, as each is alone.
TEST_F(Facade, TwoAtOnceAreAsTwoApart) {
  const std::string air = replaced(kScene, ", \"sky\": {\"none\": {}}}",
                                   "}, \"atmosphere\": {\"profile\": \"mid-latitude summer\"}");
  const std::string other_seed = replaced(kScene, "\"seed\": 5", "\"seed\": 6");
  const auto render = [&](const std::string& text, const std::string& where) {
    const ifov::Document document = ifov::Document::parse(text, "scene.json", folder_);
    ifov::Simulation::load(document).render({.folder = folder_ / where, .threads = 2});
    return products(folder_ / where);
  };
  const auto alone = render(kScene, "alone"), alone_in_air = render(air, "alone_in_air");
  for (const std::string round : {"0", "1"}) {
    std::map<std::string, std::string> in_air;
    std::thread other([&] { in_air = render(air, "in_air_" + round); });
    const auto in_none = render(kScene, "in_none_" + round);
    other.join();
    expect_same(in_none, alone);
    expect_same(in_air, alone_in_air);
  }
  // The comparison would notice: another seed is another image.
  EXPECT_FALSE(render(other_seed, "other_seed").at("image_radiance.img") == alone.at("image_radiance.img"));
}

/// One of three threads, one of one; one is cancelled, the other not.
TEST_F(Facade, TwoAtOnceHaveSettingsOfTheirOwn) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  Cube alone, beside;
  simulation.render_tiles(alone, {.threads = 1});
  const ifov::Simulation long_one =
      ifov::Simulation::load(ifov::Document::parse(endless(), "scene.json", folder_));
  class Nothing final : public ifov::TileSink {
    void write(const ifov::Tile&) override {}
  } nothing;
  ifov::CancelToken cancel;
  std::thread other([&] {
    EXPECT_THROW(long_one.render_tiles(nothing, {.threads = 1, .cancel = &cancel}), ifov::Cancelled);
  });
  const ifov::Outcome outcome = simulation.render_tiles(beside, {.threads = 3});
  cancel.cancel();
  other.join();
  EXPECT_EQ(outcome.tiles_left, 0u);
  EXPECT_EQ(beside.radiance, alone.radiance);
  EXPECT_EQ(beside.samples, alone.samples);
}

TEST_F(Facade, OneSimulationServesTwoThreads) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  Cube cubes[3];
  simulation.render_tiles(cubes[0]);
  std::thread other([&] { simulation.render_tiles(cubes[1]); });
  simulation.render_tiles(cubes[2]);
  other.join();
  EXPECT_EQ(cubes[1].radiance, cubes[0].radiance);
  EXPECT_EQ(cubes[2].radiance, cubes[0].radiance);
}

/// Two threads with folders of their own, and a third with none.
TEST_F(Facade, OpensNoFilesButThoseBelowAFolder) {
  const std::string text = replaced(kScene, "{\"plane\": {}, \"material\": \"ground\"}",
                                    R"({"mesh": {"file": "roof.obj"}, "material": "ground"})");
  for (const fs::path& place : {folder_ / "a", folder_ / "b"}) {
    fs::create_directories(place);
    std::ofstream(place / "scene.json") << text;
    std::ofstream(place / "roof.obj") << "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n";
  }
  const auto reads = [&](const char* which) {
    try {
      ifov::Document::read(folder_ / which / "scene.json");
      return true;
    } catch (const ifov::SystemError& error) {
      EXPECT_NE(std::string(error.what()).find("--inputs-below"), std::string::npos) << error.what();
      return false;
    }
  };
  std::thread other([&] {
    const ifov::InputsBelow inputs(folder_ / "b");
    for (int k = 0; k < 50; ++k) EXPECT_TRUE(reads("b") && !reads("a"));
  });
  std::thread third([&] {
    for (int k = 0; k < 50; ++k) EXPECT_TRUE(reads("a") && reads("b"));
  });
  std::optional<ifov::Document> bound;
  {
    const ifov::InputsBelow inputs(folder_ / "a");
    for (int k = 0; k < 50; ++k) EXPECT_TRUE(reads("a") && !reads("b"));
    bound = ifov::Document::read(folder_ / "a" / "scene.json");
    EXPECT_THROW(ifov::InputsBelow(folder_ / "none"), ifov::InputError);
  }
  EXPECT_TRUE(reads("a") && reads("b"));
  other.join();
  third.join();
  // What was read under it stays bound, in any thread.
  ifov::Simulation::load(*bound);
  fs::remove(folder_ / "a" / "roof.obj");
  fs::create_symlink(folder_ / "b" / "roof.obj", folder_ / "a" / "roof.obj");
  std::thread([&] {
    const ifov::Message message = ifov::check(*bound).back();
    EXPECT_EQ(message.severity, ifov::Severity::error);
    EXPECT_NE(message.text.find("--inputs-below"), std::string::npos) << message.text;
  }).join();
  ifov::Simulation::load(ifov::Document::read(folder_ / "a" / "scene.json"));
}

/// A large mesh that is being read, in a call of its own.
TEST_F(Facade, LoadingIsStoppedFromAnotherThread) {
  {
    std::ofstream mesh(folder_ / "roof.obj");
    for (int k = 0; k < 400000; ++k)
      mesh << "v " << k << " 0 0\nv " << k << " 1 0\nv " << k << " 0 1\nf -1 -2 -3\n";
  }
  const std::string text = replaced(kScene, "{\"plane\": {}, \"material\": \"ground\"}",
                                    R"({"mesh": {"file": "roof.obj"}, "material": "ground"})");
  const ifov::Document document = ifov::Document::parse(text, "scene.json", folder_);
  ifov::CancelToken cancel;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    cancel.cancel();
  });
  EXPECT_THROW(ifov::Simulation::load(document, {.cancel = &cancel}), ifov::Cancelled);
  other.join();
}

}  // namespace
}  // namespace facade_test::test_threads
