#include <chrono>
#include <cmath>

#include "facade_fixture.h"

namespace facade_test::test_runs {
namespace {

TEST_F(Facade, WritesWhatTheProgramWrites) {
  std::ofstream(folder_ / "scene.json") << kScene;
  Words words;
  const ifov::Simulation simulation = ifov::Simulation::load(ifov::Document::read(folder_ / "scene.json"));
  const ifov::Outcome outcome =
      simulation.render({.folder = folder_ / "library", .threads = 2, .progress = &words, .log = &words});
  const Ran rendered =
      program("render " + (folder_ / "scene.json").string() + " --output " + (folder_ / "program").string());
  EXPECT_EQ(outcome.exit_code(), rendered.code) << rendered.err;
  EXPECT_NE(rendered.out.find(outcome.accuracy_statement), std::string::npos) << rendered.out;
  const auto made = products(folder_ / "library");
  EXPECT_TRUE(made.contains("image_radiance.img"));
  EXPECT_TRUE(made.contains("image_run.json"));
  expect_same(made, products(folder_ / "program"));
  EXPECT_FALSE(outcome.products.empty());
  for (const ifov::Product& product : outcome.products) EXPECT_TRUE(fs::exists(product.path)) << product.path;
  EXPECT_EQ(outcome.folder, folder_ / "library");
  EXPECT_EQ(outcome.totals.pixels_done, kWidth * kHeight);
  EXPECT_EQ(outcome.tiles_done, 6u);
  EXPECT_EQ(outcome.tiles_left, 0u);
  EXPECT_EQ(words.last.pixels_done, kWidth * kHeight);
  EXPECT_EQ(words.phases, (std::vector<std::string>{"", "products"}));
}

TEST_F(Facade, HandsOverTheTilesOfTheProducts) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  simulation.render({.folder = folder_ / "out"});
  const auto before = products(folder_ / "out");
  Cube cube;
  const ifov::Outcome outcome = simulation.render_tiles(cube, {.threads = 2});
  EXPECT_EQ(cube.tiles, 6);
  EXPECT_EQ(outcome.tiles_done, 6u);
  EXPECT_TRUE(bytes_of(cube.radiance) == before.at("image_radiance.img"));
  EXPECT_TRUE(bytes_of(cube.half_width) == before.at("image_half_width.img"));
  EXPECT_TRUE(bytes_of(cube.samples) == first_band_of_three(before.at("image_samples.img")));
  EXPECT_TRUE(bytes_of(cube.reasons) == before.at("image_reasons.img"));
  EXPECT_TRUE(outcome.products.empty());
  cube.radiance[7] = std::nextafter(cube.radiance[7], 1e9f);
  EXPECT_FALSE(bytes_of(cube.radiance) == before.at("image_radiance.img"));
}

/// One scene, loaded once, as two that are loaded apart.
TEST_F(Facade, RendersASceneWithAnotherSampling) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  const ifov::Document tighter = ifov::Document::parse(
      kScene, "scene.json", folder_, {"sampling.accuracy.error=2 %", "sampling.tile=32", "seed=9"});
  Cube own, other, apart;
  simulation.render_tiles(own);
  const ifov::Outcome outcome = simulation.render_tiles(other, {.sampling = &tighter});
  ifov::Simulation::load(tighter).render_tiles(apart);
  EXPECT_EQ(other.tiles, 2);
  EXPECT_EQ(other.radiance, apart.radiance);
  EXPECT_EQ(other.half_width, apart.half_width);
  EXPECT_NE(other.radiance, own.radiance);
  EXPECT_NE(outcome.accuracy_statement.find("Asked for 2 %"), std::string::npos)
      << outcome.accuracy_statement;
  const ifov::Document single = ifov::Document::parse(
      replaced(kScene, "\"accuracy\": {\"error\": \"4 %\"}", "\"single\": {}"), "scene.json", folder_);
  EXPECT_THROW(ifov::Simulation::load(single).render_tiles(other, {.sampling = &tighter}), ifov::InputError);
}

TEST_F(Facade, GoesOnWithWhatIsFinished) {
  class StopAfterATile final : public ifov::ProgressSink {
   public:
    void report(const ifov::Progress&) override { cancel.cancel(); }
    ifov::CancelToken cancel;
  } stop;
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  EXPECT_THROW(
      simulation.render({.folder = folder_ / "out", .threads = 1, .cancel = &stop.cancel, .progress = &stop}),
      ifov::Cancelled);
  // What is finished is not thrown away unasked.
  EXPECT_THROW(simulation.render({.folder = folder_ / "out"}), ifov::InputError);
  const ifov::Outcome whole = simulation.render({.folder = folder_ / "out", .start = ifov::RunStart::resume});
  EXPECT_EQ(whole.tiles_done, 6u);
  EXPECT_EQ(whole.tiles_left, 0u);
  simulation.render({.folder = folder_ / "undisturbed", .keep_tiles = false});
  expect_same(products(folder_ / "out"), products(folder_ / "undisturbed"));
}

TEST_F(Facade, RefusesWhatMakesNoSense) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  const fs::path out = folder_ / "out";
  EXPECT_THROW(simulation.render({.folder = out, .threads = -1}), ifov::InputError);
  EXPECT_THROW(simulation.render({.folder = out, .start = ifov::RunStart::resume, .keep_tiles = false}),
               ifov::InputError);
  EXPECT_THROW(simulation.render({.folder = out, .keep_tiles = false, .keep = true}), ifov::InputError);
  EXPECT_THROW(simulation.render({.folder = out, .keep_tiles = false, .refine = true}), ifov::InputError);
  EXPECT_FALSE(fs::exists(out));
}

/// A kept run is taken to a tighter accuracy, as the program does it.
TEST_F(Facade, KeepsAndRefines) {
  ifov::Simulation::load(scene()).render({.folder = folder_ / "out", .keep = true});
  const ifov::Document tighter =
      ifov::Document::parse(kScene, "scene.json", folder_, {"sampling.accuracy.error=2 %"});
  const ifov::Outcome refined =
      ifov::Simulation::load(tighter).render({.folder = folder_ / "out", .refine = true});
  EXPECT_NE(refined.accuracy_statement.find("2 %"), std::string::npos) << refined.accuracy_statement;
}

TEST_F(Facade, EndsByADeadline) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  const auto past = std::chrono::steady_clock::now();
  const ifov::Outcome stopped = simulation.render({.folder = folder_ / "out", .deadline = past});
  EXPECT_EQ(stopped.verdict, ifov::Verdict::time_limit);
  EXPECT_EQ(stopped.exit_code(), 4);
  EXPECT_FALSE(stopped.converged());
  EXPECT_EQ(stopped.tiles_done + stopped.tiles_left, 6u);
  Cube cube;
  const ifov::Outcome none = simulation.render_tiles(cube, {.deadline = past});
  EXPECT_EQ(none.verdict, ifov::Verdict::time_limit);
  EXPECT_EQ(none.totals.pixels_total, kWidth * kHeight);
  EXPECT_EQ(none.tiles_done, static_cast<std::size_t>(cube.tiles));
}

}  // namespace
}  // namespace facade_test::test_runs
