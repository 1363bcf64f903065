#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "math/ray.h"
#include "session/loaded/parts.h"
#include "session/messages.h"
#include "session/session.h"
#include "support/truth_data.h"

namespace ifov::session::test_maps_and_terrain {
namespace {

class Messages final : public LogSink {
 public:
  void info(const std::string& message) override { text += message + "\n"; }
  void warn(const std::string& message) override { text += "warning: " + message + "\n"; }
  std::string text;
};

class MapsAndTerrain : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_maps_{}", getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  /// A grid of numbers with its lower left corner at (west, south).
  void write_grid(const std::string& name, double west, double south, double cell, int columns, int rows,
                  const std::string& numbers) {
    write(name,
          format("ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value -9999\n{}\n",
                 columns, rows, west, south, cell, numbers));
  }

  Session load(const std::string& scene, LogSink* log = nullptr, double gsd_m = 1.0) const {
    return Session::load(
        io::parse_document(
            format(
                "{{\"ifov\": 1,\n \"scene\": {},\n"
                " \"light\": {{\"sky\": {{\"radiance\": \"50 W m-2 sr-1 um-1\"}}}},\n"
                " \"sensor\": {{\"camera\": {{\"orthographic\": {{\"gsd\": \"{} m\", \"pixels\": [4, 4]}}}},\n"
                "  \"channels\": [{{\"name\": \"red\", \"monochromatic\": {{\"at\": \"0.65 um\"}}}}]}}}}",
                scene, gsd_m),
            (folder_ / "scene.json").string()),
        log);
  }

  std::string load_error(const std::string& scene) const {
    try {
      load(scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  /// What a vertical ray meets at a place of the scene.
  static scene::ResolvedSurface surface_at(const Session& session, double x, double y) {
    const scene::Scene& scene = session.parts().scene;
    return scene.resolve(hit_at(session, x, y));
  }
  static geometry::SurfacePoint hit_at(const Session& session, double x, double y) {
    const math::Ray ray{{x, y, 5000.0}, {0.0, 0.0, -1.0}};
    geometry::SurfacePoint hit;
    session.parts().scene.world->intersect({&ray, 1}, {&hit, 1});
    return hit;
  }
  /// Reflectance at 0.65 um of what a vertical ray meets.
  static double reflectance_at(const Session& session, double x, double y) {
    double sum = 0.0;
    for (const scene::Constituent& c : surface_at(session, x, y))
      sum += c.weight * session.parts().scene.materials[c.material].reflectance.at(0.65);
    return sum;
  }

  std::filesystem::path folder_;
};

void expect_in(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

const std::string kLawn =
    R"("lawn": {"reflectance": [0.1, 0.3, 0.5, 0.7], "texture": {"images": [{"file": "lawn.asc", "from": "0.6 um",)"
    R"( "to": "0.7 um", "low_left": ["0 m", "0 m"], "size": ["4 m", "2 m"], "tiling": "repeat"}]}})";

TEST_F(MapsAndTerrain, ATexturePicksCurvesByScore) {
  write_grid("lawn.asc", 0, 0, 1, 2, 1, "50 250");
  const Session session = load(
      format("{{\"materials\": {{{}}}, \"objects\": [{{\"plane\": {{}}, \"material\": \"lawn\"}}]}}", kLawn));
  // Scores of -1 and 1: mean of the curves -+ their standard deviation.
  EXPECT_NEAR(reflectance_at(session, 1.0, 1.0), 0.4 - std::sqrt(0.05), 1e-6);
  EXPECT_NEAR(reflectance_at(session, 3.0, 1.0), 0.4 + std::sqrt(0.05), 1e-6);
  EXPECT_NEAR(reflectance_at(session, -1.0, 77.0), 0.4 + std::sqrt(0.05), 1e-6);
  EXPECT_EQ(scene::truth_materials(session.parts().scene).names.front(), "lawn");
  EXPECT_EQ(surface_at(session, 1.0, 1.0).count, 2u);
}

TEST_F(MapsAndTerrain, TexturesGoWithTheClassesOfAMap) {
  write_grid("lawn.asc", 0, 0, 1, 2, 1, "50 250");
  write_grid("classes.asc", 0, 0, 10, 2, 1, "7 3");
  const Session session = load(format(
      "{{\"materials\": {{{}, \"road\": {{\"reflectance\": 0.08}}}}, \"objects\": [{{\"plane\": {{}}, \"material\": "
      "{{\"map\": {{\"file\": \"classes.asc\", \"classes\": {{\"3\": \"road\", \"7\": \"lawn\"}}}}}}}}]}}",
      kLawn));
  EXPECT_NEAR(reflectance_at(session, 1.0, 1.0), 0.4 - std::sqrt(0.05), 1e-6);
  EXPECT_NEAR(reflectance_at(session, 13.0, 1.0), 0.08, 1e-12);
}

TEST_F(MapsAndTerrain, MixturesStandSideBySide) {
  std::ofstream mixture(folder_ / "mix.img", std::ios::binary);
  const float fractions[] = {1.0f, 25.0f, 0.0f,
                             75.0f};  // two bands of 2 x 1 cells; the second cell in percent
  mixture.write(reinterpret_cast<const char*>(fractions), sizeof fractions);
  mixture.close();
  write("mix.hdr",
        "ENVI\nsamples = 2\nlines = 1\nbands = 2\ndata type = 4\ninterleave = bsq\nbyte order = 0\n");
  Messages log;
  const Session session = load(
      R"({"materials": {"soil": {"reflectance": 0.2}, "grass": {"reflectance": 0.6}},
          "objects": [{"plane": {}, "material": {"mixture": {"file": "mix.img", "low_left": ["0 m", "0 m"],
                       "size": ["2 m", "1 m"], "materials": ["soil", "grass"]}}}]})",
      &log);
  EXPECT_NEAR(reflectance_at(session, 0.5, 0.5), 0.2, 1e-9);
  EXPECT_NEAR(reflectance_at(session, 1.5, 0.5), 0.25 * 0.2 + 0.75 * 0.6, 1e-6);
  expect_in("mixture 'mix.img': the fractions of 1 of 2 cells sum to something else than 1 (100 to 100)",
            log.text);
}

TEST_F(MapsAndTerrain, MapsByTextureCoordinatesGoWithTheObject) {
  write_grid("classes.asc", 0, 0, 1, 2, 2, "1 2\n3 4");
  const Session session = load(
      R"({"materials": {"a": {"reflectance": 0.1}, "b": {"reflectance": 0.2}, "c": {"reflectance": 0.3},
                        "d": {"reflectance": 0.4}},
          "objects": [{"plane": {}, "material": {"map": {"file": "classes.asc", "by": "texture coordinates",
            "copies": [0.1, 0.1], "tiling": "repeat", "classes": {"1": "a", "2": "b", "3": "c", "4": "d"}}}}]})");
  // A plane's are metres: one copy every 10 m, cells of 5 m.
  EXPECT_NEAR(reflectance_at(session, 1.0, 9.0), 0.1, 1e-12);
  EXPECT_NEAR(reflectance_at(session, 6.0, 9.0), 0.2, 1e-12);
  EXPECT_NEAR(reflectance_at(session, 1.0, 1.0), 0.3, 1e-12);
  EXPECT_NEAR(reflectance_at(session, -4.0, 1.0), 0.4, 1e-12);
}

TEST_F(MapsAndTerrain, ReliefTiltsTheShadingNormal) {
  write_grid("bumps.asc", 0, 0, 1, 3, 3, "0 10 20\n0 10 20\n0 10 20");
  const Session session = load(
      R"({"materials": {"sand": {"reflectance": 0.3, "relief": {"heights": {"file": "bumps.asc", "unit": "1 cm"}}}},
          "objects": [{"plane": {}, "material": "sand"}]})");
  const math::Vec3 normal = surface_at(session, 1.5, 1.5).shading_normal.as_vector();
  EXPECT_NEAR(math::length(normal - math::normalized({-0.1, 0.0, 1.0})), 0.0, 1e-6);
}

TEST_F(MapsAndTerrain, ScalesFarFromThePixelAreSaid) {
  write_grid("classes.asc", 0, 0, 0.05, 2, 2, "1 1\n1 1");
  const std::string scene =
      R"({"materials": {"a": {"reflectance": 0.1}}, "objects": [{"plane": {}, "material": {"map":
          {"file": "classes.asc", "classes": {"1": "a"}}}}]})";
  expect_in("map 'classes.asc': cells of 0.05 m are 20 times finer than the ground sample of 1 m",
            load(scene, nullptr, 1.0).description());
  expect_in("map 'classes.asc': cells of 0.05 m are 25 times coarser than the ground sample of 0.002 m",
            load(scene, nullptr, 0.002).description());
  EXPECT_EQ(load(scene, nullptr, 0.1).description().find("map 'classes.asc'"), std::string::npos);
}

TEST_F(MapsAndTerrain, ClippedTexturesAreSaid) {
  std::string numbers;
  for (int k = 0; k < 400; ++k) numbers += k < 100 ? "255 " : format("{} ", 55 + k / 4);
  write_grid("lawn.asc", 0, 0, 1, 20, 20, numbers);
  Messages log;
  load(format("{{\"materials\": {{{}}}, \"objects\": [{{\"plane\": {{}}, \"material\": \"lawn\"}}]}}", kLawn),
       &log);
  expect_in(
      "warning: texture 'lawn.asc' of material 'lawn': 25.0 % of the cells hold the number 255 at the end of the "
      "histogram, which looks clipped",
      log.text);
}

TEST_F(MapsAndTerrain, WrongTexturesAreShownInTheDocument) {
  const auto plane = [](const std::string& material) {
    return "{\"materials\": {\"a\": " + material + "}, \"objects\": [{\"plane\": {}, \"material\": \"a\"}]}";
  };
  expect_in("several curves need a 'texture' that picks among them",
            load_error(plane(R"({"reflectance": [0.1, 0.2]})")));
  expect_in(
      "a texture picks among several curves; give a list of them as 'reflectance'",
      load_error(plane(R"({"reflectance": 0.1, "texture": {"images": [{"file": "l.asc", "from": "0.6 um",
                                 "to": "0.7 um"}]}})")));
  write_grid("lawn.asc", 0, 0, 1, 2, 1, "5 5");
  const std::string same = load_error(plane(
      R"({"reflectance": [0.1, 0.2], "texture": {"images": [{"file": "lawn.asc", "from": "0.6 um", "to": "0.7 um"}]}})"));
  expect_in("scene.json:2:", same);
  expect_in("all cells of the image hold the same number, 5", same);
  expect_in("a raster by texture coordinates has no place on the map",
            load_error(plane(R"({"reflectance": 0.1, "temperature": {"map": {"file": "t.asc", "unit": "K",
                "by": "texture coordinates", "low_left": ["0 m", "0 m"], "size": ["1 m", "1 m"]}}})")));
}

TEST_F(MapsAndTerrain, TerrainStandsAtTheMiddlesOfItsCells) {
  // A plane that rises by 0.5 m per metre to the east and falls by 0.25 to the north, far from zero.
  const double west = 4.0e5, south = 5.4e6;
  std::string numbers;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 6; ++column) numbers += format("{} ", 100.0 + 5.0 * column + 2.5 * row);
  write_grid("dem.asc", west, south, 10, 6, 5, numbers);
  Messages log;
  const Session session = load(
      R"({"origin": {"easting": "400000 m", "northing": "5400000 m", "height": "100 m"},
          "materials": {"a": {"reflectance": 0.1}},
          "objects": [{"terrain": {"file": "dem.asc"}, "material": "a"}]})",
      &log);
  const double x = 23.7, y = 31.4;  // the upper left node is at (5, 45) with 100 m
  EXPECT_NEAR(hit_at(session, x, y).position_m.z, 0.5 * (x - 5.0) + 0.25 * (45.0 - y), 1e-5);
  EXPECT_TRUE(hit_at(session, 5.01, 44.99).hit());
  EXPECT_FALSE(hit_at(session, 4.9, 44.9).hit());
  EXPECT_TRUE(hit_at(session, 54.99, 5.01).hit());
  expect_in("terrain 'dem.asc': 6 x 5 heights, ", log.text);
  expect_in("largest height error 0 m", log.text);
}

TEST_F(MapsAndTerrain, ATerrainMovesWithItsTransformAndHasHoles) {
  write_grid("dem.asc", 100, 200, 10, 4, 4, "5 5 5 5\n5 5 5 5\n5 5 5 -9999\n5 5 5 5");
  Messages log;
  const auto scene = [](const std::string& more) {
    return format(
        "{{\"materials\": {{\"a\": {{\"reflectance\": 0.1}}}}, \"objects\": [{{\"terrain\": {{\"file\": "
        "\"dem.asc\"{}}}, \"material\": \"a\", \"transform\": {{\"translate\": [\"-100 m\", \"-200 m\", "
        "\"1 m\"]}}}}]}}",
        more);
  };
  const Session holes = load(scene(""), &log);
  EXPECT_NEAR(hit_at(holes, 10.0, 30.0).position_m.z, 6.0, 1e-6);
  EXPECT_FALSE(hit_at(holes, 34.0, 16.0).hit());
  expect_in("1 of 16 cells have no height; they are holes", log.text);
  const Session filled = load(scene(", \"nodata\": \"fill\""));
  EXPECT_NEAR(hit_at(filled, 34.0, 16.0).position_m.z, 6.0, 1e-5);
}

TEST_F(MapsAndTerrain, ATerrainMayBeTracedInItsRaster) {
  write_grid("dem.asc", 100, 200, 10, 4, 4,
             "5.1 6.4 8.2 5.7\n5.9 3.3 4.6 9.2\n5.4 7.8 5.2 -9999\n1.3 5.8 2.9 5.5");
  Messages log;
  const auto scene = [](const std::string& more) {
    return format(
        "{{\"materials\": {{\"a\": {{\"reflectance\": 0.1}}}}, \"objects\": [{{\"terrain\": {{\"file\": "
        "\"dem.asc\"{}}}, \"material\": \"a\", \"transform\": {{\"translate\": [\"-100 m\", \"-200 m\", "
        "\"1 m\"]}}}}]}}",
        more);
  };
  const Session mesh = load(scene("")), grid = load(scene(R"(, "form": "grid")"), &log);
  int hits = 0;
  for (double x = 0.3; x < 40.0; x += 1.7)
    for (double y = 0.4; y < 40.0; y += 1.9) {
      const geometry::SurfacePoint a = hit_at(grid, x, y), b = hit_at(mesh, x, y);
      ASSERT_EQ(a.hit(), b.hit()) << x << ' ' << y;
      if (!a.hit()) continue;
      ++hits;
      EXPECT_NEAR(a.position_m.z, b.position_m.z, 1e-6);
      EXPECT_NEAR(dot(a.shading_normal, b.shading_normal.as_vector()), 1.0, 1e-9);
    }
  EXPECT_GT(hits, 200);
  expect_in("terrain 'dem.asc': 4 x 4 heights, traced as a grid of 18 triangles", log.text);
  expect_in("warning: terrain 'dem.asc': 1 of 16 cells have no height; they are holes", log.text);
  expect_in(
      "a terrain of the form 'grid' keeps every height: found a detail of 2 m, expected 0 m or the form 'mesh'",
      load_error(scene(R"(, "form": "grid", "detail": "2 m")")));
  expect_in("terrain.form' is the text \"tin\", expected 'mesh' or 'grid'",
            load_error(scene(R"(, "form": "tin")")));
}

TEST_F(MapsAndTerrain, LargeRastersAreTracedAsTheyLieWherePossible) {
  constexpr int kSide = 1001;
  write("dem.bil", std::string(4 * kSide * kSide, '\0'));  // flat: even so large a mesh is quickly made
  write("dem.hdr",
        format("NROWS {}\nNCOLS {}\nNBANDS 1\nNBITS 32\nPIXELTYPE FLOAT\nBYTEORDER I\nLAYOUT BIL\nULXMAP 0\n"
               "ULYMAP 1000\nXDIM 1\nYDIM 1\n",
               kSide, kSide));
  const auto words_of = [&](const std::string& more, bool in_prototype) {
    const std::string terrain = format(R"({{"terrain": {{"file": "dem.bil"{}}}, "material": "a"}})", more);
    Messages log;
    load(format(
             R"({{"materials": {{"a": {{"reflectance": 0.1}}}}, {}}})",
             in_prototype
                 ? format(R"("prototypes": {{"land": [{}]}}, "objects": [{{"instance": {{"of": "land"}}}}])",
                          terrain)
                 : format(R"("objects": [{}])", terrain)),
         &log);
    return log.text;
  };
  const std::string traced = "terrain 'dem.bil': 1001 x 1001 heights, traced as a grid of 2000000 triangles",
                    meshed = "triangles, largest height error 0 m";
  expect_in(traced, words_of("", false));
  expect_in(meshed, words_of("", true));
  expect_in(meshed, words_of(R"(, "form": "mesh")", false));
  expect_in(meshed, words_of(R"(, "detail": "1 cm")", false));
}

TEST_F(MapsAndTerrain, DegreesNeedAReference) {
  write_grid("dem.asc", 8.7, 49.4, 0.001, 3, 3, "1 2 3\n4 5 6\n7 8 9");
  write(
      "dem.prj",
      "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
      "UNIT[\"degree\",0.0174532925199433]]\n");
  const auto scene = [](const std::string& origin, const char* form = "mesh") {
    return format(
        "{{{}\"materials\": {{\"a\": {{\"reflectance\": 0.1}}}}, \"objects\": [{{\"terrain\": {{\"file\": "
        "\"dem.asc\", \"form\": \"{}\"}}, \"material\": \"a\"}}]}}",
        origin, form);
  };
  expect_in("whose coordinates are not metres; give the scene's 'origin' a 'crs' to take it to",
            load_error(scene("")));
  // With latitude and longitude alone, the scene's origin is their place in the projection.
  const Session session = load(
      scene(R"("origin": {"latitude": "49.4015 deg", "longitude": "8.7015 deg", "crs": "EPSG:25832"}, )"));
  const geometry::SurfacePoint hit = hit_at(session, 0.0, 0.0);
  ASSERT_TRUE(hit.hit());
  EXPECT_NEAR(hit.position_m.z, 5.0, 0.02);
  expect_in("a terrain of the form 'grid' must be in the scene's own coordinates",
            load_error(scene(
                R"("origin": {"latitude": "49.4015 deg", "longitude": "8.7015 deg", "crs": "EPSG:25832"}, )",
                "grid")));
  expect_in(
      "is no coordinate reference system that PROJ knows",
      load_error(scene(R"("origin": {"latitude": "49 deg", "longitude": "8 deg", "crs": "EPSG:1"}, )")));
  expect_in(
      "is not a map projection in metres",
      load_error(scene(R"("origin": {"latitude": "49 deg", "longitude": "8 deg", "crs": "EPSG:4326"}, )")));
  expect_in("with 'crs', give 'easting' and 'northing', or 'latitude' and 'longitude'",
            load_error(scene(R"("origin": {"crs": "EPSG:25832"}, )")));
}

TEST_F(MapsAndTerrain, TheHeidelbergModelKeepsItsDetail) {
  const auto file = test::truth_file("scenes/dem/dem_hd.tif");
  if (!file) GTEST_SKIP() << "reference data not found: scenes/dem/dem_hd.tif";
  // Heights of dem_hd.tif by GDAL at (column, row), and the places of those cells' middles.
  struct Cell {
    int column, row;
    double height_m;
  };
  const Cell cells[] = {
      {0, 0, 34.000000}, {520, 356, 286.000000}, {1040, 712, 34.000000}, {300, 600, 93.000000}};
  for (const auto& [detail_m, form] : {std::pair{0.0, "mesh"}, {5.0, "mesh"}, {0.0, "grid"}}) {
    Messages log;
    const Session session = load(
        format(
            "{{\"origin\": {{\"easting\": \"478000 m\", \"northing\": \"5474000 m\", \"crs\": \"EPSG:32632\"}}, "
            "\"materials\": {{\"a\": {{\"reflectance\": 0.1}}}}, \"objects\": [{{\"terrain\": {{\"file\": \"{}\", "
            "\"detail\": \"{} m\", \"form\": \"{}\"}}, \"material\": \"a\"}}]}}",
            file->string(), detail_m, form),
        &log);
    for (const Cell& cell : cells) {
      // A millimetre inside: rays along the rim may pass it.
      const double inwards_x = cell.column == 0 ? 1e-3 : -1e-3, inwards_y = cell.row == 0 ? -1e-3 : 1e-3;
      const double x = 465322.625829136115499 + 25.0 * (cell.column + 0.5) - 478000.0 + inwards_x;
      const double y = 5482800.390295740216970 - 25.0 * (cell.row + 0.5) - 5474000.0 + inwards_y;
      EXPECT_NEAR(hit_at(session, x, y).position_m.z, cell.height_m, detail_m + 0.01) << log.text;
    }
    expect_in("terrain 'dem_hd.tif': 1041 x 713 heights, ", log.text);
  }
}

}  // namespace
}  // namespace ifov::session::test_maps_and_terrain
