#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <thread>

#include "ifov/ifov.h"

namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 37, kHeight = 22;

/// Spheres on the ground under a black sky: loading warns of nothing.
const std::string kScene = R"({"ifov": 1, "seed": 5,
  "scene": {"materials": {"ground": {"reflectance": 0.3, "temperature": "20 degC"},
                          "ball": {"reflectance": 0.6, "temperature": "35 degC"}},
            "objects": [{"plane": {}, "material": "ground"},
                        {"sphere": {"center": ["-2 m", "1 m", "1 m"], "radius": "1.4 m"}, "material": "ball"},
                        {"sphere": {"center": ["3 m", "-1 m", "1 m"], "radius": "0.9 m"}, "material": "ball"}]},
  "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"none": {}}},
  "sensor": {"camera": {"orthographic": {"gsd": "0.3 m", "pixels": [37, 22]}},
             "channels": [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}},
                          {"name": "T", "top_hat": {"from": "10 um", "to": "11 um"}}]},
  "sampling": {"accuracy": {"error": "4 %"}, "tile": 16},
  "output": {"formats": ["envi", "geotiff", "netcdf", "png"]}})";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// Far more work than a test waits for.
std::string endless() {
  return replaced(replaced(kScene, "[37, 22]", "[4000, 4000]"), "\"4 %\"", "\"0.001 %\"");
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Every product by its name; of the run record all lines but those that say when, where and how fast.
std::map<std::string, std::string> products(const fs::path& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    std::string& content = found[name];
    if (name.ends_with(".nc")) {
      content = "the values of the others, with the date";
    } else if (name.ends_with("_run.json")) {
      std::ifstream lines(entry.path());
      for (std::string line; std::getline(lines, line);)
        if (line.find("\"date\"") == std::string::npos && line.find("\"elapsed_s\"") == std::string::npos &&
            line.find("\"threads\"") == std::string::npos && line.find("sha256") == std::string::npos)
          content += line + "\n";
    } else {
      content = bytes_of(entry.path());
    }
  }
  return found;
}

void expect_same(const std::map<std::string, std::string>& these,
                 const std::map<std::string, std::string>& those) {
  EXPECT_EQ(these.size(), those.size());
  for (const auto& [name, content] : those)
    EXPECT_TRUE(these.contains(name) && these.at(name) == content) << name;
}

struct Ran {
  int code = 0;
  std::string out, err;
};

class Facade : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ifov_facade_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  ifov::Document scene() const { return ifov::Document::parse(kScene, "scene.json", folder_); }

  /// The program, for comparison.
  Ran program(const std::string& arguments) const {
    const std::string out = folder_ / "stdout.txt", err = folder_ / "stderr.txt";
    const int status = std::system((IFOV_PROGRAM " " + arguments + " >" + out + " 2>" + err).c_str());
    return {WEXITSTATUS(status), bytes_of(out), bytes_of(err)};
  }

  fs::path folder_;
};

/// Puts tiles together, by the shapes that tile.h states.
class Cube final : public ifov::TileSink {
 public:
  void begin(const ifov::ImageDescription& image) override {
    image_ = image;
    const std::size_t pixels = static_cast<std::size_t>(image.width_px) * image.height_px;
    radiance.resize(pixels * image.channels.size());
    half_width.resize(radiance.size());
    samples.resize(pixels);
    reasons.resize(pixels);
  }
  void write(const ifov::Tile& tile) override {
    const std::scoped_lock lock(mutex_);
    ++tiles;
    for (int row = 0; row < tile.height_px; ++row)
      for (int column = 0; column < tile.width_px; ++column) {
        const std::size_t from = static_cast<std::size_t>(row) * tile.width_px + column;
        const std::size_t x = tile.x_px + column, y = tile.y_px + row;
        samples[y * image_.width_px + x] = tile.samples[from];
        reasons[y * image_.width_px + x] = tile.reasons[from];
        for (int c = 0; c < tile.channels; ++c) {  // by lines, as an ENVI cube of interleave "bil" has them
          const std::size_t to = (y * tile.channels + c) * image_.width_px + x;
          radiance[to] = tile.radiance[from * tile.channels + c];
          half_width[to] = tile.half_width[from * tile.channels + c];
        }
      }
  }

  int tiles = 0;
  std::vector<float> radiance, half_width;
  std::vector<std::uint32_t> samples;
  std::vector<std::uint16_t> reasons;

 private:
  std::mutex mutex_;
  ifov::ImageDescription image_;
};

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Of a cube of 32-bit numbers: all points of a pixel come before those of either kind.
std::string first_band_of_three(const std::string& cube) {
  constexpr std::size_t kLine = 4 * kWidth;
  std::string band;
  for (std::size_t line = 0; line < cube.size() / kLine; line += 3) band += cube.substr(line * kLine, kLine);
  return band;
}

/// Keeps what is said, from any thread.
class Words final : public ifov::LogSink, public ifov::ProgressSink {
 public:
  void info(const std::string& message) override { keep(infos, message); }
  void warn(const std::string& message) override { keep(warnings, message); }
  void report(const ifov::Progress& progress) override {
    const std::scoped_lock lock(mutex_);
    last = progress;
  }
  void phase(const std::string& what) override { keep(phases, what); }

  std::vector<std::string> infos, warnings, phases;
  ifov::Progress last;

 private:
  void keep(std::vector<std::string>& list, const std::string& message) {
    const std::scoped_lock lock(mutex_);
    list.push_back(message);
  }
  std::mutex mutex_;
};

TEST_F(Facade, SaysWhatAnImageIs) {
  const ifov::ImageDescription image = ifov::Simulation::load(scene()).image();
  EXPECT_EQ(image.width_px, kWidth);
  EXPECT_EQ(image.height_px, kHeight);
  ASSERT_EQ(image.channels.size(), 2u);
  EXPECT_EQ(image.channels[0].name, "red");
  EXPECT_NEAR(image.channels[0].centre_um, 0.65, 1e-6);
  EXPECT_NEAR(image.channels[0].fwhm_um, 0.04, 1e-6);
  EXPECT_NEAR(image.channels[1].centre_um, 10.5, 1e-6);
  EXPECT_EQ("ifov " + ifov::version(), program("--version").out.substr(0, 5 + ifov::version().size()));
  EXPECT_EQ(ifov::document_schema(), program("schema").out);
  EXPECT_EQ(ifov::reason_name(1), "samples");
  EXPECT_EQ(ifov::reason_name(-1), "");
  EXPECT_EQ(ifov::reason_name(16), "");
}

TEST_F(Facade, TakesValuesInPlaceOfTheDocuments) {
  const ifov::Document document =
      ifov::Document::parse(kScene, "scene.json", folder_, {"sensor.camera.orthographic.pixels=[5, 3]"});
  EXPECT_EQ(ifov::Simulation::load(document).image().width_px, 5);
  EXPECT_THROW(ifov::Document::parse(kScene, "scene.json", folder_, {"seed"}), ifov::InputError);
}

TEST_F(Facade, LocatesErrors) {
  try {
    ifov::Document::parse(replaced(kScene, "\"zenith\"", "\"zenit\""), "scene.json", folder_);
    FAIL() << "no error";
  } catch (const ifov::InputError& error) {
    EXPECT_EQ(error.position().file, folder_ / "scene.json");
    EXPECT_EQ(error.position().line, 7);
    EXPECT_GT(error.position().column, 1);
    EXPECT_NE(std::string(error.what()).find("zenit"), std::string::npos);
    EXPECT_EQ(ifov::exit_code_of(error), 1);
  }
  EXPECT_THROW(ifov::Document::read(folder_ / "none.json"), ifov::SystemError);
}

/// A relative name of a file leads to the folder that was given with the text.
TEST_F(Facade, ChecksFilesThatADocumentNames) {
  const std::string text = replaced(kScene, "{\"plane\": {}, \"material\": \"ground\"}",
                                    R"({"mesh": {"file": "roof.obj"}, "material": "ground"})");
  const ifov::Document document = ifov::Document::parse(text, "scene.json", folder_);
  const auto error_of = [&] {
    const std::vector<ifov::Message> messages = ifov::check(document);
    return messages.empty() ? ifov::Message() : messages.back();
  };
  std::ofstream(folder_ / "roof.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n";
  const ifov::Message wrong = error_of();
  EXPECT_EQ(wrong.severity, ifov::Severity::error);
  EXPECT_EQ(wrong.position.line, 4);
  EXPECT_NE(wrong.text.find("roof.obj:4"), std::string::npos) << wrong.text;
  std::ofstream(folder_ / "roof.obj") << "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n";
  EXPECT_EQ(error_of().severity, ifov::Severity::statement);
}

TEST_F(Facade, ChecksAsTheProgramDoes) {
  // The sky is not declared: that is warned of.
  const std::string text = replaced(kScene, ", \"sky\": {\"none\": {}}", "");
  std::ofstream(folder_ / "scene.json") << text;
  std::string statements, warnings;
  for (const ifov::Message& message : ifov::check(ifov::Document::read(folder_ / "scene.json"))) {
    if (message.severity == ifov::Severity::statement) statements += message.text + "\n";
    if (message.severity == ifov::Severity::warning) warnings += "ifov: warning: " + message.text + "\n";
  }
  const Ran checked = program("check --no-cache " + (folder_ / "scene.json").string());
  EXPECT_EQ(checked.code, 6);
  EXPECT_FALSE(warnings.empty());
  EXPECT_EQ(warnings, checked.err);
  EXPECT_EQ(statements, checked.out);
}

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

TEST_F(Facade, CastsRays) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  const std::vector<std::array<double, 3>> from{{-2, 1, 10}, {8, 8, 5}, {0, 0, 1}},
      to{{0, 0, -3}, {0, 0, -1}, {0, 0, 1}};
  const std::vector<ifov::RayHit> hits = simulation.cast(from, to);
  ASSERT_EQ(hits.size(), 3u);
  EXPECT_TRUE(hits[0].hit);
  EXPECT_NEAR(hits[0].distance_m, 10.0 - 2.4, 1e-9);
  EXPECT_NEAR(hits[0].position_m[2], 2.4, 1e-9);
  EXPECT_NEAR(hits[0].normal[2], 1.0, 1e-6);
  EXPECT_EQ(hits[0].object, 1);
  EXPECT_EQ(hits[0].material, "ball");
  EXPECT_EQ(hits[1].object, 0);
  EXPECT_EQ(hits[1].material, "ground");
  EXPECT_FALSE(hits[2].hit);
  // More than one batch, on several threads, each as alone.
  const std::vector<std::array<double, 3>> many(5000, from[0]), down(5000, to[0]);
  for (const ifov::RayHit& hit : simulation.cast(many, down, 3))
    EXPECT_EQ(hit.distance_m, hits[0].distance_m);
  EXPECT_THROW(simulation.cast(from, {}), ifov::InputError);
  EXPECT_THROW(simulation.cast(std::span(from).first(1), std::vector<std::array<double, 3>>{{0, 0, 0}}),
               ifov::InputError);
}

TEST(FacadeRadiometry, PlanckAndItsInverse) {
  EXPECT_NEAR(ifov::planck_radiance(10.0, 300.0), 9.924, 1e-3);
  EXPECT_NEAR(ifov::brightness_temperature(10.0, ifov::planck_radiance(10.0, 300.0)), 300.0, 1e-9);
}

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
  for (const std::string round : {"0", "1", "2"}) {
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

TEST_F(Facade, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const ifov::Document document =
      ifov::Document::parse(replaced(kScene, ", \"sky\": {\"none\": {}}", ""), "scene.json", folder_);
  ifov::check(document);
  ifov::Simulation::load(document).render({.folder = folder_ / "out"});
  try {
    ifov::Document::parse("{\"ifov\": 1, \"scene\": [", "broken.json");
  } catch (const ifov::InputError&) {
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(FacadeErrors, HaveTheProgramsExitCodes) {
  EXPECT_EQ(ifov::exit_code_of(ifov::InputError("x")), 1);
  EXPECT_EQ(ifov::exit_code_of(ifov::SystemError("x")), 2);
  EXPECT_EQ(ifov::exit_code_of(std::bad_alloc()), 2);
  EXPECT_EQ(ifov::exit_code_of(ifov::Cancelled()), 130);
  EXPECT_EQ(ifov::exit_code_of(std::logic_error("x")), 3);
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
