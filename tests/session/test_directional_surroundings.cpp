// Surroundings that reflect by direction: what an image sees of them and through air that they light is what the column over such ground
// tells, which was checked term by term.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "session/loaded/parts.h"
#include "session/plausibility/light_warnings.h"
#include "session/session.h"
#include "session/surveys/atmosphere_survey.h"
#include "transport/sky/surroundings_light.h"
#include "transport/spectral_scene.h"

namespace ifov::session::test_directional_surroundings {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180.0;

class DirectionalSurroundings : public testing::Test {
 protected:
  DirectionalSurroundings() : folder_(fs::temp_directory_path() / format("ifov_around_{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~DirectionalSurroundings() override { fs::remove_all(folder_); }

  /// A camera of 3 x 3 pixels of 0.4 m, 4 km above. Of a `plane` of material it sees that, else a mat at one side and the surroundings
  /// elsewhere.
  struct Asked {
    std::string surroundings, plane = "";
    double zenith_deg = 0.0, azimuth_deg = 0.0;
    bool stokes = false;
    std::string air = R"("atmosphere": {"profile": "mid-latitude summer", "aerosol": {"type": "maritime"}},)";
    std::string sky = "";
  };
  /// Those that it names: albedos of one that nothing has take as long as those of others.
  static std::string materials(const Asked& asked) {
    std::string listed = R"("soot": {"reflectance": 0})";
    for (const auto& [name, described] : {
             std::pair{"sea",
                       R"({"reflectance": 0.01, "scattering": {"sea": {"wind": 6, "wind_from": "30 deg"}}})"},
             {"land", R"({"reflectance": 0.2, "scattering": {"rpv": {"k": 0.7, "asymmetry": -0.15}}})"},
             {"even", R"({"reflectance": 0.2, "scattering": {"rpv": {"k": 1, "asymmetry": 0, "rho_c": 1}}})"},
             {"grass", R"({"reflectance": 0.2, "temperature": "300 K"})"},
             {"mirror", R"({"reflectance": 0.9, "scattering": "mirror"})"},
             {"leaf", R"({"reflectance": 0.3, "transmittance": 0.3})"},
         })
      if ((asked.surroundings + asked.plane).find(name) != std::string::npos)
        listed += format(R"(, "{}": {})", name, described);
    return listed;
  }
  static io::Document document(const Asked& asked) {
    const double far_m = 4e3 * std::tan(asked.zenith_deg * kDegree), azimuth = asked.azimuth_deg * kDegree;
    const std::string object =
        asked.plane.empty()
            ? R"({"box": {"low": ["0.3 m", "-3 m", "0 m"], "high": ["3 m", "3 m", "0.01 m"]}, "material": "soot"})"
            : format(R"({{"plane": {{}}, "material": "{}"}})", asked.plane);
    return io::parse_document(
        format(
            R"({{"ifov": 1, "scene": {{"materials": {{{}}},
                 "objects": [{}]}},
                 "light": {{"sun": {{"point": {{"zenith": "50 deg", "azimuth": "130 deg"}}}}{}{}}},
                 {}
                 "sensor": {{"camera": {{"frame": {{"focal_length": "10 m", "pitch": "1 mm", "pixels": [3, 3],
                     "position": ["{} m", "{} m", "4 km"], "look_at": ["0 m", "0 m", "0 m"]}}}},
                   "stokes": {},
                   "channels": [{{"name": "blue", "gaussian": {{"center": "0.45 um", "fwhm": "2 nm"}}}},
                                {{"name": "infrared", "gaussian": {{"center": "0.865 um", "fwhm": "5 nm"}}}}]}},
                 "sampling": {{"grid": {{"elements": [{}, {}]}}}}}})",
            materials(asked), object, asked.sky,
            asked.surroundings.empty() ? std::string() : R"(, "surroundings": )" + asked.surroundings,
            asked.air, far_m * std::sin(azimuth), far_m * std::cos(azimuth), asked.stokes,
            asked.plane.empty() ? 1 : 24, asked.plane.empty() ? 1 : 24),
        "around.json");
  }
  std::string bytes(const Asked& asked, const std::string& product = "radiance") const {
    RunOptions options;
    options.output_folder = folder_ / "out";
    Session::load(document(asked), nullptr).render(options);
    std::ifstream file(options.output_folder / ("image_" + product + ".img"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Of the middle pixel, by band.
  std::vector<double> middle(const Asked& asked, const std::string& product = "radiance") const {
    const std::string image = bytes(asked, product);
    std::vector<float> values(image.size() / sizeof(float));
    std::copy_n(image.data(), image.size(), reinterpret_cast<char*>(values.data()));
    const std::size_t bands = values.size() / 9;
    std::vector<double> found;
    for (std::size_t b = 0; b < bands; ++b) found.push_back(static_cast<double>(values[(bands + b) * 3 + 1]));
    return found;
  }
  static std::vector<io::AtmosphereReport::Channel> column(const Asked& asked, const std::string& ground) {
    AtmosphereQuestion question;
    question.ground_material = ground;
    return survey_atmosphere(document(asked), question).channels;
  }
  static std::string refusal(const std::string& surroundings) {
    try {
      Session::load(document({surroundings}), nullptr);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  fs::path folder_;
};

// By the glint and away from it, towards the Sun's side and across; with polarization, which the sea makes of an unpolarized Sun and
// of a polarized sky.
TEST_F(DirectionalSurroundings, SeenInAnImageAreAsTheColumnOverThem) {
  struct View {
    const char* material;
    double zenith_deg, azimuth_deg;
  };
  for (const View& view : {View{"sea", 45.0, 320.0}, View{"sea", 60.0, 130.0}}) {
    Asked asked{format(R"({{"material": "{}"}})", view.material), "", view.zenith_deg, view.azimuth_deg,
                true};
    const std::vector<double> seen = middle(asked, "stokes");
    const auto told = column(asked, view.material);
    for (std::size_t c = 0; c < told.size(); ++c) {
      const auto& light = told[c].light.over_ground;
      EXPECT_NEAR(seen[c] / light.radiance, 1.0, 3e-3) << view.material << c;
      const double polarized = std::hypot(seen[2 + c], seen[4 + c]);
      EXPECT_NEAR(polarized, std::hypot(light.q, light.u), 3e-3 * light.radiance) << view.material << c;
    }
    if (view.zenith_deg != 45.0) {
      // Without Q and U the radiance has what such ground makes of the sky's polarization: 0.8 % in blue.
      asked.stokes = false;
      const std::vector<double> scalar = middle(asked);
      for (std::size_t c = 0; c < told.size(); ++c)
        EXPECT_NEAR(scalar[c] / told[c].light.over_ground.radiance, 1.0, 3e-3) << c;
      continue;
    }
    // Planted: as much alike in every direction.
    asked.surroundings = R"({"reflectance": 0.06})";
    asked.stokes = false;
    EXPECT_GT(std::abs(middle(asked)[1] / told[1].light.over_ground.radiance - 1.0), 0.03);
  }
}

// The ground of the scene is traced, and the air is lit by ground of the same kind all around.
TEST_F(DirectionalSurroundings, APlaneOfTheirMaterialIsAsTheColumnOverIt) {
  Asked asked{R"({"material": "land"})", "land", 30.0, 60.0};
  const std::vector<double> seen = middle(asked);
  const auto told = column(asked, "land");
  for (std::size_t c = 0; c < told.size(); ++c)
    EXPECT_NEAR(seen[c] / told[c].light.over_ground.radiance, 1.0, 3e-3) << c;
  // Planted: air lit by ground that reflects the same share alike in every direction.
  asked.surroundings = R"({"reflectance": 0.22})";
  EXPECT_GT(std::abs(middle(asked)[0] / told[0].light.over_ground.radiance - 1.0), 6e-3);
}

// Traced sea reflects the sky's polarization whether the sensor tells it or not; unpolarized skylight left it 0.8 % too dark.
TEST_F(DirectionalSurroundings, ATracedSeaIsAsTheColumnOverIt) {
  const auto told = column({R"({"material": "sea"})", "sea", 60.0, 130.0, true}, "sea");
  for (const bool stokes : {false, true}) {
    const Asked asked{R"({"material": "sea"})", "sea", 60.0, 130.0, stokes};
    const std::string image = bytes(asked);
    std::vector<float> values(image.size() / sizeof(float));
    std::copy_n(image.data(), image.size(), reinterpret_cast<char*>(values.data()));
    double mean = 0.0;
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t k = 0; k < 3; ++k) mean += static_cast<double>(values[row * 6 + k]) / 9.0;
    EXPECT_NEAR(mean / told[0].light.over_ground.radiance, 1.0, 3e-3) << stokes;
  }
}

TEST_F(DirectionalSurroundings, OfALambertianMaterialAreThoseOfItsReflectance) {
  const std::string named = bytes({R"({"material": "grass"})"});
  EXPECT_EQ(named, bytes({R"({"reflectance": 0.2, "temperature": "300 K"})"}));
  EXPECT_NE(named, bytes({R"({"reflectance": 0.21, "temperature": "300 K"})"}));
}

// With Lambert's parameters: the same light on every way, that of other code.
TEST_F(DirectionalSurroundings, ThatReflectAlikeAreAsLambertian) {
  const std::string uniform = R"(, "sky": {"radiance": "40 W m-2 sr-1 um-1"})";
  for (const bool air : {false, true}) {
    Asked even{R"({"material": "even", "temperature": "290 K"})", "", 30.0, 60.0},
        flat{R"({"reflectance": 0.2, "temperature": "290 K"})", "", 30.0, 60.0};
    if (!air) even.air = flat.air = "", even.sky = flat.sky = uniform;
    const std::vector<double> found = middle(even), wanted = middle(flat);
    for (std::size_t c = 0; c < wanted.size(); ++c)
      EXPECT_NEAR(found[c] / wanted[c], 1.0, air ? 2e-3 : 1e-4) << air << c;
  }
}

TEST_F(DirectionalSurroundings, TellTheirPartsAndWhatIsTakenAsLambertian) {
  const Session session =
      Session::load(document({R"({"material": "sea", "temperature": "290 K"})"}), nullptr);
  const transport::SpectralScene& scene = *session.parts().spectral_scene;
  ASSERT_NE(scene.surroundings_light(), nullptr);
  radiometry::SpectrumBlock rows(4, scene.node_count());
  const math::Vec3 down = math::normalized(math::Vec3{0.3, -0.5, -0.6});
  const float* whole = scene.surroundings_radiance(down, rows.row(0));
  scene.split_surroundings(down, rows.row(1), rows.row(2), rows.row(3));
  for (std::size_t n = 0; n < scene.node_count(); ++n) {
    EXPECT_GT(rows.row(2)[n], 0.0f);
    EXPECT_GT(rows.row(3)[n], 0.0f);
    EXPECT_NEAR(whole[n], rows.row(1)[n] + rows.row(2)[n] + rows.row(3)[n], 1e-5f * whole[n]);
  }
  EXPECT_EQ(
      surroundings_statement(session.parts()),
      "surroundings: 'sea' by its BRDF, below the horizon and in the air; what of the scene's own ground differs from "
      "them lights the air as Lambertian ground does; what the air scatters of their light again is as of the mean of both sides of the Sun's plane");
}

// The ground in the picture, and that is said.
TEST_F(DirectionalSurroundings, UndeclaredAreLambertian) {
  const Session session = Session::load(document({"", "sea"}), nullptr);
  EXPECT_EQ(
      session.parts().assumed_surroundings,
      "surroundings: none declared; taken as the mean of the ground in the picture (100 % 'sea'), which emits nothing; it is "
      "taken to reflect alike in every direction, which 'light.surroundings' with a 'material' need not");
  EXPECT_EQ(session.parts().spectral_scene->surroundings_light(), nullptr);
  EXPECT_EQ(surroundings_statement(session.parts()), "");
}

TEST_F(DirectionalSurroundings, RefuseWhatIsNoGround) {
  EXPECT_NE(refusal(R"({"material": "seas"})")
                .find("there is no material 'seas' for the surroundings; did you mean 'sea'? There are "),
            std::string::npos);
  EXPECT_NE(refusal(R"({"material": "mirror"})")
                .find("the material 'mirror' sends all light in one direction: it is no ground"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"material": "leaf"})").find("the material 'leaf' lets light through"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"material": "sea", "reflectance": 0.1})").find("material"), std::string::npos);
}

}  // namespace
}  // namespace ifov::session::test_directional_surroundings
