// Parameters of scattering models from maps, and materials whose sides differ, from a document: images against those of plain
// numbers, and what is said of mistakes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/polarized/stokes_columns.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_mapped_parameters {
namespace {

class KeptTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

class MappedParameters : public testing::Test {
 protected:
  static constexpr int kSide = 4;

  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_parameters_{}", getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// kSide x kSide cells of 1 m about the origin, as the pixels lie.
  void write_map(const std::string& name,
                 const std::function<std::string(int column, int row)>& number) const {
    std::ofstream file(folder_ / name);
    file << format("ncols {0}\nnrows {0}\nxllcorner {1}\nyllcorner {1}\ncellsize 1\nNODATA_value -9999\n",
                   kSide, -0.5 * kSide);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) file << number(column, row) << " ";
      file << "\n";
    }
  }
  void write_map(const std::string& name, double number) const {
    write_map(name, [&](int, int) { return format("{}", number); });
  }

  Session load(const std::string& materials, const std::string& light, const std::string& sampling = kGrid,
               const std::string& object = R"({"plane": {}, "material": "m"})", double um = 0.55) const {
    return Session::load(
        io::parse_document(
            format(
                "{{\"ifov\": 1, \"scene\": {{\"materials\": {{{}}},\n \"objects\": [{}]}},\n \"light\": {{{}}},\n"
                " \"sensor\": {{\"camera\": {{\"orthographic\": {{\"gsd\": \"1 m\", \"pixels\": [{}, {}]{}}}}}, {}\n"
                "  \"channels\": [{{\"name\": \"c\", \"monochromatic\": {{\"at\": \"{} um\"}}}}]}},\n \"sampling\": {}}}",
                materials, object, light, kSide, kSide, camera_, sensor_, um, sampling),
            (folder_ / "scene.json").string()),
        nullptr);
  }
  static sampling::TileResult rendered(const Session& session) {
    render::RenderControl control;
    control.threads = 1;
    KeptTile tile;
    render::render_image(session.parts().job(), control, tile);
    return tile.result;
  }
  static std::string gloss(const std::string& roughness) {
    return format(R"("m": {{"reflectance": 0.3, "scattering": {{"rough_dielectric": {{"roughness": {}}}}}}})",
                  roughness);
  }
  /// Of a glossy plane under the Sun alone: no noise.
  double plain(double roughness) const {
    return static_cast<double>(rendered(load(gloss(format("{}", roughness)), kSun)).mean[0]);
  }
  std::string said(const std::string& materials) const {
    try {
      load(materials, kSun);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "nothing";
  }

  static constexpr const char* kGrid = R"({"grid": {"elements": [2, 2]}})";
  static constexpr const char* kSun =
      R"("sun": {"point": {"zenith": "30 deg", "azimuth": "180 deg"}}, "sky": {"none": {}})";
  std::filesystem::path folder_;
  std::string camera_, sensor_;  // more keys
};

// The same of a sensor that tells polarization: halves of two roughnesses have the Stokes vectors of either, and with any map the
// radiance is that of a sensor that tells nothing else.
TEST_F(MappedParameters, ArePolarizedAsPlainNumbersAre) {
  camera_ = R"(, "view_zenith": "45 deg", "view_azimuth": "20 deg")";
  const auto told = [&](const std::string& roughness) {
    sensor_ = R"("stokes": true,)";
    return rendered(load(gloss(roughness), kSun));
  };
  const auto stokes = [](const sampling::TileResult& tile, std::size_t pixel, std::size_t component) {
    return static_cast<double>(
        component == 0 ? tile.mean[pixel]
                       : tile.layer(render::StokesLayers::kMean)->values<float>()[3 * pixel + component - 1]);
  };
  write_map("wear.asc", [](int column, int) { return column < kSide / 2 ? "0.3" : "0.45"; });
  const std::string by_map = R"({"map": {"file": "wear.asc"}})";
  const sampling::TileResult halves = told(by_map), smooth = told("0.3"), rough = told("0.45");
  // Seen aslant from the side the halves are not columns any more: each pixel is one of both, and there are such of either.
  int of_smooth = 0, of_rough = 0;
  for (std::size_t p = 0; p < kSide * kSide; ++p) {
    const double i = stokes(halves, p, 0);
    const auto off = [&](const sampling::TileResult& plain) {
      double most = 0.0;
      for (std::size_t c = 0; c < 4; ++c)
        most = std::max(most, std::abs(stokes(halves, p, c) - stokes(plain, p, c)));
      return most;
    };
    of_smooth += off(smooth) < 1e-5 * i, of_rough += off(rough) < 1e-5 * i;
  }
  EXPECT_EQ(of_smooth + of_rough, kSide * kSide);
  EXPECT_GE(std::min(of_smooth, of_rough), kSide);
  const double i = stokes(smooth, 0, 0);
  EXPECT_GT(std::hypot(stokes(smooth, 0, 1), stokes(smooth, 0, 2)), 0.02 * i);
  EXPECT_GT(std::abs(stokes(smooth, 0, 1) - stokes(rough, 0, 1)), 1e-3 * i) << "nothing was told apart";

  write_map("wear.asc", [](int column, int row) { return format("{}", 0.2 + 0.02 * column + 0.05 * row); });
  const sampling::TileResult graded = told(by_map);
  sensor_ = "";
  const sampling::TileResult plain = rendered(load(gloss(by_map), kSun));
  for (std::size_t p = 0; p < kSide * kSide; ++p)
    EXPECT_NEAR(graded.mean[p], plain.mean[p], 1e-5f * plain.mean[p]) << p;
}

TEST_F(MappedParameters, AMapOfOneValueIsThePlainNumber) {
  write_map("wear.asc", 0.25);
  const sampling::TileResult image = rendered(load(gloss(R"({"map": {"file": "wear.asc"}})"), kSun));
  const double truth = plain(0.25);
  for (const float value : image.mean) EXPECT_NEAR(static_cast<double>(value), truth, 1e-6 * truth);
  // A fault that is seen: another roughness.
  EXPECT_GT(std::abs(plain(0.26) - truth), 1e-3 * truth);
}

TEST_F(MappedParameters, HalvesOfTwoValuesAreThePlainOnes) {
  // Bytes, scaled.
  write_map("wear.asc", [](int column, int) { return column < kSide / 2 ? "51" : "102"; });
  const Session session =
      load(gloss(R"({"map": {"file": "wear.asc", "unit": 0.00392156862745098, "offset": 0.1}})"), kSun);
  const sampling::TileResult image = rendered(session);
  const double first = plain(0.3), second = plain(0.5);
  for (int p = 0; p < kSide * kSide; ++p)
    EXPECT_NEAR(static_cast<double>(image.mean[static_cast<std::size_t>(p)]),
                p % kSide < kSide / 2 ? first : second, 1e-5 * first);
  EXPECT_GT(std::abs(first - second), 0.02 * first);
  // Levels count as their material, and labels do not part them.
  const scene::TruthMaterials truth = scene::truth_materials(session.parts().scene);
  EXPECT_EQ(truth.names, (std::vector<std::string>{"m", "surroundings"}));
  EXPECT_FALSE(session.parts().scene.assignments.front().mixes_materials());
}

TEST_F(MappedParameters, AGradientOfALobeIsThePlainNumbersCellByCell) {
  const std::string plastic =
      R"("m": {"reflectance": 0.1, "scattering": {"ward": {"specular": 0.1, "roughness": )";
  const auto roughness = [](int cell) { return 0.2 + 0.004 * cell; };
  write_map("wear.asc", [&](int column, int row) { return format("{}", roughness(kSide * row + column)); });
  // Of two levels side by side a path takes one.
  const Session session =
      load(plastic + R"({"map": {"file": "wear.asc"}}}}})", kSun, R"({"grid": {"elements": [24, 24]}})");
  const sampling::TileResult image = rendered(session);
  // Some cells lie between levels: one of the document and fewer than 16 of the map, and surroundings.
  EXPECT_LT(session.parts().scene.materials.size(), 16u);
  double worst = 0.0, mean = 0.0, truth = 0.0, first = 0.0, last = 0.0;
  for (int p = 0; p < kSide * kSide; ++p) {
    const double value = static_cast<double>(image.mean[static_cast<std::size_t>(p)]);
    last = static_cast<double>(rendered(load(format("{}{}}}}}}}", plastic, roughness(p)), kSun)).mean[0]);
    if (p == 0) first = last;
    worst = std::max(worst, std::abs(value / last - 1.0));
    mean += value;
    truth += last;
  }
  RecordProperty("levels", static_cast<int>(session.parts().scene.materials.size()));
  RecordProperty("worst_1e6", static_cast<int>(1e6 * worst));
  EXPECT_LT(worst, 0.005);
  EXPECT_NEAR(mean, truth, 2e-3 * truth);
  // A fault that is seen: one value for all.
  EXPECT_GT(std::abs(first / last - 1.0), 0.02);
}

TEST_F(MappedParameters, TheMeanOfAGradientIsThatOfPlainNumbers) {
  const std::string matt = R"("m": {"reflectance": 0.6, "scattering": {"oren_nayar": {"slope": )";
  const auto slope = [](int cell) { return 5 + 3 * cell; };
  write_map("slope.asc", [&](int column, int row) { return format("{}", slope(kSide * row + column)); });
  const sampling::TileResult image = rendered(load(matt + R"({"map": {"file": "slope.asc"}}}}})", kSun));
  const auto with = [&](int deg) {
    return static_cast<double>(rendered(load(format("{}\"{} deg\"}}}}}}", matt, deg), kSun)).mean[0]);
  };
  double mean = 0.0, truth = 0.0;
  for (int p = 0; p < kSide * kSide; ++p) {
    mean += static_cast<double>(image.mean[static_cast<std::size_t>(p)]) / (kSide * kSide);
    truth += with(slope(p)) / (kSide * kSide);
  }
  EXPECT_NEAR(mean, truth, 1e-3 * truth);
  // A fault that is seen: the map's mean in its place.
  EXPECT_GT(std::abs(with(27) / truth - 1.0), 1e-3);
}

/// Shapes whose light is sought: what a map of one value does not change.
TEST_F(MappedParameters, HighlightsAndHotThingsAreSoughtAsThoseOfAPlainNumber) {
  write_map("wear.asc", 0.15);
  constexpr const char* kAccuracy = R"({"accuracy": {"error": "2 %"}})";
  const auto image = [&](const std::string& roughness, bool hot) {
    const std::string metal = format(
        R"("m": {{"reflectance": 1{}, "scattering": {{"rough_conductor": {{"index": "titanium", "roughness": {}}}}}}}, "wall": {{"reflectance": 0.4, "temperature": "290 K"}})",
        hot ? R"(, "temperature": "900 K")" : "", roughness);
    constexpr const char* kThings =
        R"({"sphere": {"center": ["0.3 m", "0.2 m", "1 m"], "radius": "0.6 m"}, "material": "m"}, {"plane": {}, "material": "wall"})";
    return rendered(
        load(metal,
             hot ? R"("sky": {"none": {}})"
                 : R"("sun": {"disc": {"zenith": "30 deg", "azimuth": "180 deg"}}, "sky": {"none": {}})",
             kAccuracy, kThings, hot ? 4.0 : 0.55));
  };
  for (const bool hot : {false, true}) {
    const sampling::TileResult mapped = image(R"({"map": {"file": "wear.asc"}})", hot),
                               one = image("0.15", hot);
    const sampling::TileResult other = image("0.3", hot);
    double fault = 0.0;
    for (std::size_t p = 0; p < one.mean.size(); ++p) {
      EXPECT_NEAR(mapped.mean[p], one.mean[p], 1e-4 * static_cast<double>(one.mean[p]));
      EXPECT_NEAR(mapped.half_width[p], one.half_width[p],
                  1e-3 * static_cast<double>(one.half_width[p]) + 1e-6);
      EXPECT_EQ(mapped.reasons[p], one.reasons[p]);
      fault = std::max(fault, std::abs(static_cast<double>(other.mean[p] / one.mean[p]) - 1.0));
    }
    EXPECT_GT(fault, 0.01);  // another roughness is seen
  }
}

TEST_F(MappedParameters, AGradientUnderTheSkyIsWithinItsErrorBars) {
  constexpr const char* kLight =
      R"("sun": {"point": {"zenith": "30 deg", "azimuth": "180 deg"}}, "sky": {"radiance": "60 W m-2 sr-1 um-1"})";
  constexpr const char* kAccuracy = R"({"accuracy": {"error": "1 %"}})";
  write_map("wear.asc", [](int column, int) { return format("{}", 0.2 + 0.1 * column); });
  const sampling::TileResult image =
      rendered(load(gloss(R"({"map": {"file": "wear.asc"}})"), kLight, kAccuracy));
  int held = 0, fault = 0;
  for (int column = 0; column < kSide; ++column) {
    const sampling::TileResult one =
        rendered(load(gloss(format("{}", 0.2 + 0.1 * column)), kLight, kAccuracy));
    for (int row = 0; row < kSide; ++row) {
      const auto p = static_cast<std::size_t>(kSide * row + column);
      const auto off = [&](std::size_t q) {
        return std::abs(image.mean[q] - one.mean[p]) <= image.half_width[q] + one.half_width[p];
      };
      held += off(p);
      fault += off(static_cast<std::size_t>(kSide * row + (column + 1) % kSide));
    }
  }
  EXPECT_GE(held, kSide * kSide - 1);
  EXPECT_LT(fault, kSide * kSide / 2);  // the cell beside
}

TEST_F(MappedParameters, TwoMapsAndMapsOfAnglesStandSideBySide) {
  write_map("slope.asc", [](int column, int) { return format("{}", 10 + 10 * column); });
  const std::string matt = R"("m": {"reflectance": 0.6, "scattering": {"oren_nayar": {"slope": )";
  const sampling::TileResult image = rendered(load(matt + R"({"map": {"file": "slope.asc"}}}}})", kSun));
  for (int column = 0; column < kSide; ++column) {
    const double truth = static_cast<double>(
        rendered(load(format("{}\"{} deg\"}}}}}}", matt, 10 + 10 * column), kSun)).mean[0]);
    EXPECT_NEAR(static_cast<double>(image.mean[static_cast<std::size_t>(column)]), truth, 2e-3 * truth);
  }

  write_map("k.asc", [](int column, int) { return format("{}", 0.6 + 0.05 * column); });
  write_map("theta.asc", [](int, int row) { return format("{}", -0.3 + 0.05 * row); });
  const std::string field = R"("m": {"reflectance": 0.07, "scattering": {"rpv": {"k": )";
  const Session session =
      load(field + R"({"map": {"file": "k.asc"}}, "asymmetry": {"map": {"file": "theta.asc"}}}}})", kSun);
  const sampling::TileResult both = rendered(session);
  const auto one = [&](int column, int row) {
    return static_cast<double>(
        rendered(load(format("{}{}, \"asymmetry\": {}}}}}}}", field, 0.6 + 0.05 * column, -0.3 + 0.05 * row),
                      kSun))
            .mean[0]);
  };
  for (const int p : {0, 5, 11, 14}) {
    const double truth = one(p % kSide, p / kSide);
    EXPECT_NEAR(static_cast<double>(both.mean[static_cast<std::size_t>(p)]), truth, 2e-3 * truth);
    EXPECT_GT(std::abs(one((p + 2) % kSide, p / kSide) / truth - 1.0), 2e-3);
  }
}

TEST_F(MappedParameters, WarmSurfacesEmitByTheirLevels) {
  write_map("wear.asc", [](int column, int) { return column < kSide / 2 ? "0.2" : "0.9"; });
  const std::string metal =
      R"("m": {"reflectance": 1, "temperature": "400 K", "scattering": {"rough_conductor": {"index": "titanium", "roughness": )";
  const auto image = [&](const std::string& roughness) {
    return rendered(load(metal + roughness + "}}}", R"("sky": {"none": {}})", kGrid,
                         R"({"plane": {}, "material": "m"})", 10.0));
  };
  const sampling::TileResult mapped = image(R"({"map": {"file": "wear.asc"}})");
  const double smooth = static_cast<double>(image("0.2").mean[0]),
               rough = static_cast<double>(image("0.9").mean[0]);
  EXPECT_NEAR(static_cast<double>(mapped.mean[0]), smooth, 1e-5 * smooth);
  EXPECT_NEAR(static_cast<double>(mapped.mean[kSide - 1]), rough, 1e-5 * rough);
  EXPECT_GT(rough, 1.05 * smooth);
}

TEST_F(MappedParameters, MistakesAreToldAtTheirPlace) {
  const auto with = [&](const std::string& map) { return said(gloss(format(R"({{"map": {}}})", map))); };
  const auto expect_said = [&](const std::string& part, const std::string& text) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("scene.json:1:"), std::string::npos) << text;
  };
  expect_said("no.asc", with(R"({"file": "no.asc"})"));
  write_map("wear.asc", [](int column, int row) { return column == 2 && row == 1 ? "1.7" : "0.4"; });
  expect_said("1.7 at row 2, column 3 of", with(R"({"file": "wear.asc"})"));
  expect_said("makes 'roughness' 1.7; it lies between 0 and 1", with(R"({"file": "wear.asc"})"));
  expect_said("has no band 2; it has 1", with(R"({"file": "wear.asc", "band": 2})"));
  write_map("wear.asc", [](int column, int row) { return column == 3 && row == 0 ? "-9999" : "0.4"; });
  expect_said("no number at row 1, column 4 of", with(R"({"file": "wear.asc"})"));
  write_map("wear.asc", [](int column, int) { return column < 2 ? "0.005" : "0.4"; });
  expect_said("below 0.01", with(R"({"file": "wear.asc"})"));
  expect_said("(where 'roughness' is 0.005)", with(R"({"file": "wear.asc"})"));
  write_map("wear.asc", 0.4);
  expect_said(
      "'index' cannot be a map: of a model's parameters numbers, angles and lengths can",
      said(
          R"("m": {"reflectance": 0.3, "scattering": {"rough_dielectric": {"index": {"map": {"file": "wear.asc"}}, "roughness": 0.2}}})"));
  expect_said(
      "'distribution' cannot be a map",
      said(
          R"("m": {"reflectance": 0.3, "scattering": {"rough_dielectric": {"distribution": {"map": {"file": "wear.asc"}}, "roughness": 0.2}}})"));
  expect_said(
      "'lobe' is one map too many: of the parameters of a material 2 may come from maps",
      said(
          R"("m": {"reflectance": 0.3, "scattering": {"hapke": {"b0": {"map": {"file": "wear.asc"}}, "h": {"map": {"file": "wear.asc"}}, "lobe": {"map": {"file": "wear.asc"}}}}})"));
  // Fringes of a film are finer than 64 levels tell.
  std::ofstream wedge(folder_ / "wedge.asc");
  wedge << "ncols 800\nnrows 1\nxllcorner -400\nyllcorner -0.5\ncellsize 1\n";
  for (int column = 0; column < 800; ++column) wedge << 100 + column << " ";
  wedge.close();
  expect_said(
      "more than 0.5 %; give the map a narrower range or fewer values",
      said(
          R"("m": {"reflectance": 1, "scattering": {"film": {"n": 1.38, "k": 0, "thickness": {"map": {"file": "wedge.asc", "unit": "1 nm"}}, "substrate_n": 1.9, "substrate_k": 0}}})"));
}

class SidesOfASheet : public MappedParameters {
 protected:
  static constexpr const char* kSides =
      R"("m": {"front": "red", "back": "blue"}, "red": {"reflectance": 0.5, "temperature": "320 K"}, "blue": {"reflectance": 0.1, "temperature": "280 K"})";
  /// A sheet seen from its front (corners counter-clockwise) or its back.
  double seen(const char* material, bool front, const char* materials, const char* light,
              double um = 0.55) const {
    const std::string sheet = format(
        R"({{"polygon": {{"vertices": [["-9 m", "-9 m", "0 m"], ["{0} m", "{1} m", "0 m"], ["9 m", "9 m", "0 m"], ["{1} m", "{0} m", "0 m"]]}}, "material": "{2}"}})",
        front ? 9 : -9, front ? -9 : 9, material);
    return static_cast<double>(rendered(load(materials, light, kGrid, sheet, um)).mean[0]);
  }
};

TEST_F(SidesOfASheet, EachShowsItsOwnMaterial) {
  const double red = seen("red", true, kSides, kSun), blue = seen("blue", true, kSides, kSun);
  EXPECT_NEAR(red, 5.0 * blue, 1e-5 * red);
  EXPECT_NEAR(seen("m", true, kSides, kSun), red, 1e-6 * red);
  EXPECT_NEAR(seen("m", false, kSides, kSun), blue, 1e-6 * blue);
  // By the other side's name it is the other.
  const std::string swapped = std::string(R"("x": {"reflectance": 0}, )") + kSides;
  EXPECT_GT(std::abs(seen("m", false, swapped.c_str(), kSun) - red), 0.5 * red);
}

TEST_F(SidesOfASheet, EachEmitsAtItsOwnTemperature) {
  constexpr const char* kDark = R"("sky": {"none": {}})";
  const double red = seen("red", true, kSides, kDark, 10.0), blue = seen("blue", true, kSides, kDark, 10.0);
  EXPECT_NEAR(seen("m", true, kSides, kDark, 10.0), red, 1e-6 * red);
  EXPECT_NEAR(seen("m", false, kSides, kDark, 10.0), blue, 1e-6 * blue);
  EXPECT_GT(std::abs(red - blue), 0.05 * blue);
}

TEST_F(SidesOfASheet, MistakesAreTold) {
  const auto expect_said = [&](const std::string& part, const std::string& materials) {
    const std::string text = said(materials);
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("scene.json:1:"), std::string::npos) << text;
  };
  expect_said("there is no material 'gren'; did you mean 'green'?",
              R"("m": {"front": "green", "back": "gren"}, "green": {"reflectance": 0.1})");
  expect_said("lacks the key 'back'", R"("m": {"front": "green"}, "green": {"reflectance": 0.1})");
  expect_said("'back' cannot stand beside 'reflectance'",
              R"("m": {"reflectance": 0.1, "back": "green"}, "green": {"reflectance": 0.1})");
  expect_said(
      "'n' has a front and a back itself",
      R"("m": {"front": "n", "back": "g"}, "n": {"front": "g", "back": "g"}, "g": {"reflectance": 0.1})");
  expect_said(
      "light comes through 'leaf' and not through 'wall'",
      R"("m": {"front": "wall", "back": "leaf"}, "wall": {"reflectance": 0.1}, "leaf": {"reflectance": 0.1, "transmittance": 0.3})");
  expect_said(
      "'a' lets through 0.2 and 'b' 0.3",
      R"("m": {"front": "a", "back": "b"}, "a": {"reflectance": 0.1, "transmittance": 0.2}, "b": {"reflectance": 0.1, "transmittance": 0.3})");
}

}  // namespace
}  // namespace ifov::session::test_mapped_parameters
