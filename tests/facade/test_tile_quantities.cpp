// What tiles in memory tell beside radiance is what the cubes of a run hold.
#include <cstring>
#include <variant>

#include "facade_fixture.h"

namespace facade_test::test_tile_quantities {
namespace {

/// Every quantity as its cube would have it: by lines, as bytes.
class Quantities final : public ifov::TileSink {
 public:
  void begin(const ifov::ImageDescription& image) override { image_ = image; }
  void write(const ifov::Tile& tile) override {
    const std::scoped_lock lock(mutex_);
    for (const ifov::TileQuantity& quantity : tile.quantities) {
      described[quantity.description.name] = quantity.description;
      std::visit([&](const auto& values) { put(tile, quantity.description, values); }, quantity.values);
    }
  }
  const ifov::ImageDescription& image() const { return image_; }

  std::map<std::string, std::string> cubes;
  std::map<std::string, ifov::QuantityDescription> described;

 private:
  template <class Value>
  void put(const ifov::Tile& tile, const ifov::QuantityDescription& of, std::span<const Value> values) {
    const std::size_t bands = of.bands.size(), width = image_.width_px;
    ASSERT_EQ(values.size(), bands * tile.width_px * tile.height_px) << of.name;
    std::string& cube = cubes[of.name];
    cube.resize(bands * width * image_.height_px * sizeof(Value));
    std::size_t k = 0;
    for (int row = 0; row < tile.height_px; ++row)
      for (int column = 0; column < tile.width_px; ++column)
        for (std::size_t band = 0; band < bands; ++band, ++k) {
          const std::size_t to = ((tile.y_px + row) * bands + band) * width + tile.x_px + column;
          std::memcpy(cube.data() + to * sizeof(Value), &values[k], sizeof(Value));
        }
  }

  std::mutex mutex_;
  ifov::ImageDescription image_;
};

TEST_F(Facade, TellsOfPixelsWhatCubesHold) {
  const std::string text = replaced(kScene, R"("output": {)", R"("output": {"products": ["all"], )");
  const ifov::Document document = ifov::Document::parse(text, "scene.json", folder_);
  const ifov::Simulation simulation = ifov::Simulation::load(document);
  simulation.render({.folder = folder_ / "out"});
  Quantities told;
  simulation.render_tiles(told, {.quantities = {"all"}});
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("image_") || !name.ends_with(".img") || name == "image_radiance.img") continue;
    const std::string quantity = name.substr(6, name.size() - 10);
    EXPECT_EQ(told.cubes[quantity], bytes_of(entry.path())) << quantity;
    ++compared;
  }
  EXPECT_EQ(compared, static_cast<int>(told.cubes.size()));
  EXPECT_GE(compared, 9);
  EXPECT_EQ(told.described["abundance"].bands, (std::vector<std::string>{"ground", "ball", "surroundings"}));
  EXPECT_EQ(told.described["samples"].unit, "count");
  EXPECT_EQ(told.described["standard_error"].bands, (std::vector<std::string>{"red", "T"}));
}

TEST_F(Facade, TellsWhatIsAskedForAlone) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  Quantities none, two;
  simulation.render_tiles(none);
  simulation.render_tiles(two, {.quantities = {"standard_error", "abundance"}});
  EXPECT_TRUE(none.cubes.empty());
  EXPECT_EQ(two.cubes.size(), 2u);
  try {
    simulation.render_tiles(none, {.quantities = {"abundence"}});
    FAIL() << "no error";
  } catch (const ifov::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("found 'abundence'; expected 'all', 'radiance'"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("did you mean 'abundance'?"), std::string::npos) << error.what();
  }
}

TEST_F(Facade, DescribesTheRunOfAnImage) {
  Quantities told;
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  const ifov::Document other = ifov::Document::parse(
      replaced(kScene, "\"4 %\"}", "\"3 %\", \"confidence\": 0.9}"), "scene.json", folder_, {"seed=8"});
  simulation.render_tiles(told, {.sampling = &other});
  EXPECT_EQ(told.image().seed, 8u);
  EXPECT_EQ(told.image().confidence, 0.9);
  EXPECT_NE(told.image().accuracy_asked.find("3 %"), std::string::npos) << told.image().accuracy_asked;
  const ifov::ImageDescription own = simulation.image();
  EXPECT_EQ(own.seed, 5u);
  EXPECT_EQ(own.confidence, 0.95);
  EXPECT_EQ(own.materials, (std::vector<std::string>{"ground", "ball", "surroundings"}));
  // The middle of the image is the scene's origin, rows go down from the north.
  ASSERT_TRUE(own.geotransform);
  const std::array<double, 6> t = *own.geotransform;
  EXPECT_NEAR(t[0], -0.5 * kWidth * 0.3, 1e-9);
  EXPECT_NEAR(t[3], 0.5 * kHeight * 0.3, 1e-9);
  EXPECT_NEAR(t[1], 0.3, 1e-12);
  EXPECT_NEAR(t[5], -0.3, 1e-12);
  EXPECT_EQ(own.crs, "");
}

}  // namespace
}  // namespace facade_test::test_tile_quantities
