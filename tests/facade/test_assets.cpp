#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include "ifov/ifov.h"
namespace test_assets {

namespace {

namespace fs = std::filesystem;

/// A terrain from a raster, warmed by a map, a mesh of two materials with a texture's coordinates, copies of a ball, and a
/// leaf whose spectrum is a table.
const std::string kScene = R"({"ifov": 1, "seed": 5,
  "scene": {
    "materials": {"ground": {"reflectance": 0.3, "temperature": {"map": {"file": "MAP", "unit": "degC"}}},
                  "wall": {"reflectance": {"csv": "LEAF", "wavelength_unit": "nm", "scale": 0.01, "outside": "extend"},
                           "temperature": "30 degC"},
                  "roof": {"reflectance": 0.7, "temperature": "40 degC"}},
    "prototypes": {"ball": [{"sphere": {"center": ["0 m", "0 m", "0 m"], "radius": "0.5 m"}, "material": "roof"}]},
    "objects": [{"terrain": {"file": "DEM", "unit": "1 m"}, "material": "ground"},
                {"mesh": {"file": "HOUSE"}, "material": {"slots": {"wall": "wall", "roof": "roof"}}},
                {"instances": {"of": "ball", "csv": "BALLS"}}]},
  "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"none": {}}},
  "sensor": {"camera": {"orthographic": {"gsd": "0.5 m", "pixels": [24, 20]}},
             "channels": [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}},
                          {"name": "T", "top_hat": {"from": "10 um", "to": "11 um"}}]},
  "sampling": {"accuracy": {"error": "8 %"}, "tile": 16}})";

std::string with(std::string text, const std::map<std::string, std::string>& names) {
  for (const auto& [what, by] : names)
    for (std::size_t at = 0; (at = text.find("\"" + what + "\"", at)) != std::string::npos;)
      text.replace(at + 1, what.size(), by);
  return text;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

const std::map<std::string, std::string> kFiles{{"MAP", "map.asc"},
                                                {"DEM", "dem.asc"},
                                                {"HOUSE", "house.obj"},
                                                {"LEAF", "leaf.csv"},
                                                {"BALLS", "balls.csv"}};
const std::map<std::string, std::string> kAssets{{"MAP", "asset:map"},
                                                 {"DEM", "asset:dem"},
                                                 {"HOUSE", "asset:house"},
                                                 {"LEAF", "asset:leaf"},
                                                 {"BALLS", "asset:balls"}};

class AssetsOfPrograms : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ifov_assets_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    const std::array<double, 6> transform{-8.0, 1.0, 0.0, 8.0, 0.0, -1.0};
    dem_.width = map_.width = 16, dem_.height = map_.height = 16;
    dem_.geotransform = map_.geotransform = transform;
    for (int row = 0; row < 16; ++row)
      for (int column = 0; column < 16; ++column) {
        dem_.values.push_back(0.25f * static_cast<float>((row * 5 + column * 3) % 4));
        map_.values.push_back(20.0f + 0.5f * static_cast<float>(row + column));
      }
    house_.vertices = {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {0, 0, 4}};
    house_.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    house_.materials = {0, 0, 1, 1};
    house_.material_names = {"wall", "roof"};
    leaf_ = {{400, 600, 700, 12000}, {5, 40, 60, 10}};
    balls_.positions_m = {{5, 4, 1.5}, {-5, -4, 2.0}};
    balls_.yaw_rad = {0.0, 0.5 * M_PI};
    balls_.scale = {1.0, 1.5};
    write("dem.asc", ascii(dem_));
    write("map.asc", ascii(map_));
    write("house.obj",
          "v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nv 0 0 4\nusemtl wall\nf 1 2 5\nf 2 3 5\nusemtl roof\n"
          "f 3 4 5\nf 4 1 5\n");
    write("leaf.csv", "400,5\n600,40\n700,60\n12000,10\n");
    write("balls.csv", "5,4,1.5,0,1\n-5,-4,2,90,1.5\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const char* name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  static std::string ascii(const ifov::RasterAsset& raster) {
    std::string text = "ncols 16\nnrows 16\nxllcorner -8\nyllcorner -8\ncellsize 1\n";
    for (std::size_t k = 0; k < raster.values.size(); ++k)
      text += std::to_string(raster.values[k]) + ((k + 1) % 16 == 0 ? "\n" : " ");
    return text;
  }
  ifov::Assets assets() const {
    ifov::Assets all;
    all.add("dem", dem_), all.add("map", map_), all.add("house", house_), all.add("leaf", leaf_);
    all.add("balls", balls_);
    return all;
  }
  ifov::Document document(const std::map<std::string, std::string>& names) const {
    return ifov::Document::parse(with(kScene, names), "scene.json", folder_);
  }
  static std::string error_of(const ifov::Document& document) {
    const ifov::Message last = ifov::check(document).back();
    EXPECT_EQ(last.severity, ifov::Severity::error);
    EXPECT_GT(last.position.line, 0) << last.text;
    return last.text;
  }
  template <class Asset>
  static std::string refusal(const Asset& asset) {
    try {
      ifov::Assets().add("x", asset);
    } catch (const ifov::InputError& error) {
      return error.what();
    }
    return "taken";
  }

  fs::path folder_;
  ifov::RasterAsset dem_, map_;
  ifov::MeshAsset house_;
  ifov::SpectrumAsset leaf_;
  ifov::CopiesAsset balls_;
};

TEST_F(AssetsOfPrograms, GiveTheBytesThatFilesGive) {
  ifov::Simulation::load(document(kFiles)).render({.folder = folder_ / "files"});
  const ifov::Document from_memory = document(kAssets).with_assets(assets());
  const ifov::Simulation simulation = ifov::Simulation::load(from_memory, {.scene_cache = true});
  simulation.render({.folder = folder_ / "memory"});
  for (const char* name :
       {"image_radiance.img", "image_half_width.img", "image_samples.img", "image_abundance.img"}) {
    const std::string made = bytes_of(folder_ / "memory" / name);
    EXPECT_FALSE(made.empty()) << name;
    EXPECT_TRUE(made == bytes_of(folder_ / "files" / name)) << name;
  }
  // Each of them is seen: with another one it is another picture.
  const auto differs = [&](const char* name, const auto& other) {
    ifov::Assets all = assets();
    all.add(name, other);
    ifov::Simulation::load(document(kAssets).with_assets(all)).render({.folder = folder_ / name});
    EXPECT_FALSE(bytes_of(folder_ / name / "image_radiance.img") ==
                 bytes_of(folder_ / "files" / "image_radiance.img"))
        << name;
  };
  ifov::RasterAsset dem = dem_, map = map_;
  for (float& height : dem.values) height *= 2.0f;
  for (float& kelvin : map.values) kelvin += 1.0f;
  ifov::MeshAsset house = house_;
  house.vertices[4][2] = 5.0;
  differs("dem", dem), differs("map", map), differs("house", house);
  differs("leaf", ifov::SpectrumAsset{{400, 12000}, {30, 10}});
  differs("balls", ifov::CopiesAsset{{{5, 4, 1.5}}, {}, {}});
}

TEST_F(AssetsOfPrograms, AreToldOfByRunRecordsAndKeptByNoCache) {
  const ifov::Simulation simulation =
      ifov::Simulation::load(document(kAssets).with_assets(assets()), {.scene_cache = true});
  simulation.render({.folder = folder_ / "out"});
  EXPECT_FALSE(fs::exists(folder_ / "scene.ifovcache"));
  std::string notes;
  for (const std::string& note : ifov::run_info(folder_ / "out" / "image_run.json").notes)
    notes += note + "\n";
  for (const char* name : {"dem", "map", "house", "leaf", "balls"})
    EXPECT_NE(notes.find("'asset:" + std::string(name) + "' came from a program's memory: "),
              std::string::npos)
        << notes;
}

TEST_F(AssetsOfPrograms, ARunGoesOnWithTheSameOnesAlone) {
  class StopAfterATile final : public ifov::ProgressSink {
   public:
    void report(const ifov::Progress&) override { cancel.cancel(); }
    ifov::CancelToken cancel;
  } stop;
  const ifov::Document whole = document(kAssets).with_assets(assets());
  EXPECT_THROW(ifov::Simulation::load(whole).render(
                   {.folder = folder_ / "out", .threads = 1, .cancel = &stop.cancel, .progress = &stop}),
               ifov::Cancelled);
  const ifov::RunStatus status = ifov::run_status(folder_ / "out");
  EXPECT_FALSE(status.complete);
  EXPECT_LT(status.tiles_done, status.tiles_wanted);
  ifov::Assets other = assets();
  ifov::SpectrumAsset leaf = leaf_;
  leaf.values[1] = std::nextafter(leaf.values[1], 1.0);
  other.add("leaf", leaf);
  const ifov::Simulation changed = ifov::Simulation::load(document(kAssets).with_assets(other));
  try {
    changed.render({.folder = folder_ / "out", .start = ifov::RunStart::resume});
    FAIL() << "it went on";
  } catch (const ifov::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'asset:leaf' has other bytes"), std::string::npos)
        << error.what();
  }
  const ifov::Outcome outcome =
      ifov::Simulation::load(whole).render({.folder = folder_ / "out", .start = ifov::RunStart::resume});
  EXPECT_EQ(outcome.tiles_left, 0u);
}

TEST_F(AssetsOfPrograms, ErrorsSayWhichThereAre) {
  EXPECT_NE(error_of(document(kAssets)).find("it gives none"), std::string::npos);
  std::map<std::string, std::string> names = kAssets;
  names["HOUSE"] = "asset:hause";
  const std::string missing = error_of(document(names).with_assets(assets()));
  EXPECT_NE(
      missing.find(
          "there is no 'asset:hause'; did you mean 'asset:house'? Assets of the program: 'asset:balls', "
          "'asset:dem', 'asset:house', 'asset:leaf' and 'asset:map'"),
      std::string::npos)
      << missing;
  names["HOUSE"] = "asset:dem";
  const std::string other = error_of(document(names).with_assets(assets()));
  EXPECT_NE(other.find("'asset:dem' is a raster of 16 x 16 cells; expected a mesh"), std::string::npos)
      << other;
  const ifov::Document city = ifov::Document::parse(
      R"({"ifov": 1, "scene": {"materials": {"m": {"reflectance": 0.3}},
          "objects": [{"city": {"file": "asset:dem"}, "material": "m"}]},
          "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "0 deg"}}, "sky": {"none": {}}},
          "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 4]}},
                     "channels": [{"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}}]}})",
      "city.json", folder_);
  const std::string kind = error_of(city.with_assets(assets()));
  EXPECT_NE(kind.find("'asset:dem' is a raster of 16 x 16 cells; expected a file"), std::string::npos)
      << kind;
}

TEST_F(AssetsOfPrograms, ArraysThatDoNotFitAreRefused) {
  ifov::MeshAsset mesh = house_;
  mesh.triangles[2][1] = 5;
  EXPECT_EQ(refusal(mesh), "asset 'x': triangle 2 names vertex 5; there are 5, from 0");
  mesh = house_;
  mesh.materials.pop_back();
  EXPECT_EQ(refusal(mesh), "asset 'x': 3 materials; expected 4, one for each triangle");
  mesh = house_;
  mesh.materials[1] = 2;
  EXPECT_EQ(refusal(mesh), "asset 'x': triangle 1 has material 2; material_names holds 2");
  mesh = house_;
  mesh.vertices[1][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(mesh), "asset 'x': vertex 1 holds nan; expected numbers");
  mesh = house_;
  mesh.uv = {{0, 0}};
  EXPECT_EQ(refusal(mesh), "asset 'x': 1 pairs of texture coordinates; expected 5, one for each vertex");
  ifov::RasterAsset raster = dem_;
  raster.values.pop_back();
  EXPECT_EQ(refusal(raster), "asset 'x': 255 values; expected 256: 1 bands of 16 rows of 16");
  raster = dem_;
  raster.crs = "EPSG:nowhere";
  EXPECT_NE(refusal(raster), "taken");
  EXPECT_EQ(refusal(ifov::SpectrumAsset{{1.0, 2.0}, {0.5}}),
            "asset 'x': 1 values; expected 2, one for each wavelength");
  EXPECT_EQ(refusal(ifov::CopiesAsset{{{0, 0, 0}}, {}, {0.0}}),
            "asset 'x': copy 0 is turned by 0 and scaled by 0; expected numbers, and a scale above 0");
  EXPECT_EQ(refusal(house_), "taken");
}

}  // namespace
}  // namespace test_assets
