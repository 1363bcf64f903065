// What the program prints of atmospheres, runs, products and materials, as values.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ifov/ifov.h"
namespace test_values {

namespace {

namespace fs = std::filesystem;

const std::string kScene = R"({"ifov": 1, "seed": 5,
  "scene": {"materials": {"ground": {"reflectance": 0.3, "temperature": "20 degC"},
                          "ball": {"reflectance": 0.6, "temperature": "35 degC"}},
            "objects": [{"plane": {}, "material": "ground"},
                        {"sphere": {"center": ["2 m", "1 m", "1 m"], "radius": "1.4 m"}, "material": "ball"}]},
  "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}},
  "atmosphere": {"profile": "mid-latitude summer"},
  "sensor": {"camera": {"orthographic": {"gsd": "0.5 m", "pixels": [20, 16]}},
             "channels": [{"name": "blue", "gaussian": {"center": "0.45 um", "fwhm": "40 nm"}},
                          {"name": "T", "top_hat": {"from": "10 um", "to": "11 um"}}]},
  "sampling": {"accuracy": {"error": "4 %"}, "tile": 8}})";

constexpr double kDegree = M_PI / 180.0;

class Values : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ifov_values_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "scene.json") << kScene;
  }
  void TearDown() override { fs::remove_all(folder_); }

  ifov::Document scene() const { return ifov::Document::read(folder_ / "scene.json"); }
  std::string said(const std::string& arguments) const {
    const fs::path out = folder_ / "stdout.txt";
    const int status = std::system((IFOV_PROGRAM " " + arguments + " >" + out.string() + " 2>&1").c_str());
    static_cast<void>(status);
    std::ifstream stream(out, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST_F(Values, OfAnAtmosphere) {
  const ifov::AtmosphereReport noon = ifov::survey_atmosphere(scene(), {.sun = {{20 * kDegree, 0.0}}});
  const ifov::AtmosphereReport evening = ifov::survey_atmosphere(scene(), {.sun = {{75 * kDegree, 0.0}}});
  ASSERT_EQ(noon.channels.size(), 2u);
  EXPECT_EQ(noon.channels[0].name, "blue");
  EXPECT_NEAR(*noon.sun_zenith_rad, 20 * kDegree, 1e-9);
  EXPECT_NEAR(noon.channels[0].light.wavelength_um, 0.45, 0.01);
  EXPECT_NEAR(noon.channels[1].first_um, 10.0, 0.01);
  // A low Sun's light goes a longer way; the way to the sensor is the same.
  EXPECT_LT(evening.channels[0].light.sun_transmittance, 0.8 * noon.channels[0].light.sun_transmittance);
  EXPECT_EQ(evening.channels[0].light.view_transmittance, noon.channels[0].light.view_transmittance);
  EXPECT_GT(noon.channels[1].light.thermal_path, 100 * noon.channels[1].light.solar_path);
  EXPECT_FALSE(noon.sky);
  EXPECT_EQ(ifov::survey_atmosphere(scene()).table(), said("atmosphere " + path("scene.json")));
  EXPECT_THROW(ifov::survey_atmosphere(scene(), {.sky = true, .sky_channel = "green"}), ifov::InputError);
  ifov::CancelToken cancel;
  cancel.cancel();
  EXPECT_THROW(ifov::survey_atmosphere(scene(), {.cancel = &cancel}), ifov::Cancelled);
}

TEST_F(Values, OfASky) {
  const ifov::AtmosphereReport report = ifov::survey_atmosphere(scene(), {.sky = true});
  ASSERT_TRUE(report.sky);
  const ifov::SkyLight& sky = *report.sky;
  EXPECT_EQ(sky.channel, "blue");
  EXPECT_FALSE(sky.thermal);
  ASSERT_EQ(sky.stokes.size(), sky.zenith_rad.size() * sky.azimuth_rad.size());
  double most = 0.0;
  for (const auto& [i, q, u] : sky.stokes) {
    EXPECT_GT(i, 0.0);
    most = std::max(most, std::hypot(q, u) / i);
  }
  EXPECT_GT(most, 0.3);  // blue sky is polarized across from the Sun
  EXPECT_LT(most, 1.0);
  EXPECT_FALSE(sky.neutral_points.empty());
  EXPECT_EQ(report.sky_csv().substr(0, 1), "#");
}

TEST_F(Values, OfARunBeforeWhileAndAfterIt) {
  const ifov::Simulation simulation = ifov::Simulation::load(scene());
  const ifov::Forecast forecast = simulation.forecast({.folder = folder_ / "out"});
  EXPECT_GT(forecast.probes, 0u);
  EXPECT_GT(forecast.rays, 0.0);
  EXPECT_GT(forecast.product_bytes, 0u);
  EXPECT_TRUE(forecast.shortages.empty());
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_THROW(ifov::run_status(folder_ / "out"), ifov::InputError);

  for (const int number : {1, 2})
    simulation.render({.folder = folder_ / std::to_string(number), .share = {number, 2}});
  EXPECT_THROW(simulation.render({.folder = folder_ / "3", .share = {3, 2}}), ifov::InputError);
  const ifov::RunStatus half = ifov::run_status(folder_ / "1");
  EXPECT_FALSE(half.complete);
  EXPECT_EQ(half.tiles_done, half.tiles_wanted);
  EXPECT_EQ(half.share_count, 2);
  EXPECT_EQ(half.seed, 5u);
  EXPECT_LT(half.pixels_done, 20 * 16);
  EXPECT_EQ(half.text, said("status " + path("1")));

  const ifov::Outcome merged =
      ifov::merge({folder_ / "1", folder_ / "2"}, {.output_folder = folder_ / "merged"});
  EXPECT_EQ(merged.totals.pixels_done, 20 * 16);
  EXPECT_TRUE(ifov::run_status(folder_ / "merged").complete);
  EXPECT_THROW(ifov::merge({folder_ / "1"}, {.output_folder = folder_ / "half"}), ifov::InputError);

  const std::vector<fs::path> records = ifov::products_in(folder_ / "merged");
  ASSERT_EQ(records.size(), 1u);
  const ifov::RunInfo info = ifov::run_info(records[0]);
  EXPECT_EQ(info.width_px, 20);
  EXPECT_EQ(info.version, ifov::version());
  EXPECT_EQ(info.seed, 5u);
  EXPECT_EQ(info.document_text, kScene);
  ASSERT_EQ(info.channels.size(), 2u);
  EXPECT_EQ(*info.pixels, 320u);
  EXPECT_GE(*info.channels[0].maximum, *info.channels[0].mean);
  const ifov::CubeInfo cube = ifov::cube_info(folder_ / "merged" / "image_radiance.img");
  EXPECT_EQ(cube.bands, 2);
  EXPECT_EQ(cube.interleave, "bil");
  EXPECT_NEAR(cube.wavelength[0], 0.45, 1e-3);

  // The mean of all pixels is that of the record, and known better than that of one.
  const std::vector<ifov::RegionMean> means =
      ifov::region_means(folder_ / "merged", {"0,0,20,16", "3,4,4,5"});
  ASSERT_EQ(means.size(), 2u);
  EXPECT_EQ(means[0].pixels, 320u);
  EXPECT_EQ(means[1].pixels, 1u);
  EXPECT_NEAR(means[0].channels[0].mean, *info.channels[0].mean, 1e-5 * *info.channels[0].mean);
  EXPECT_LT(means[0].channels[0].half_width, means[1].channels[0].half_width);
  EXPECT_THROW(ifov::region_means(folder_ / "merged", {"1,2"}), ifov::InputError);
  EXPECT_THROW(ifov::run_info(folder_ / "scene.json"), ifov::InputError);
}

TEST_F(Values, OfAPreview) {
  ifov::Preview picture;
  try {
    picture = ifov::Simulation::load(scene().for_preview(16)).preview({.seconds = 0.1, .threads = 1});
  } catch (const ifov::SystemError& error) {
    if (std::string(error.what()).find("built without Cairo") == std::string::npos) throw;
    GTEST_SKIP() << error.what();
  }
  EXPECT_EQ(picture.width_px, 16);
  EXPECT_EQ(picture.pixels.size(), static_cast<std::size_t>(picture.width_px) * picture.height_px);
  EXPECT_NE(picture.statement.find("promises no accuracy"), std::string::npos);
}

TEST_F(Values, OfMaterials) {
  const std::vector<ifov::Material> all = ifov::search_materials();
  EXPECT_GT(all.size(), 20u);
  EXPECT_EQ(ifov::materials_list(all), said("materials"));
  const std::vector<ifov::Material> found = ifov::search_materials("asphalt");
  ASSERT_FALSE(found.empty());
  const ifov::Material leaf = ifov::search_materials("leaf, aspen").at(0);
  ASSERT_FALSE(leaf.curves.empty());
  const ifov::Material::Curve& curve = leaf.curves[0];
  ASSERT_EQ(curve.reflectance.size(), curve.wavelength_um.size());
  ASSERT_EQ(curve.transmittance.size(), curve.wavelength_um.size());
  for (std::size_t k = 0; k < curve.wavelength_um.size(); ++k)
    EXPECT_NEAR(curve.reflectance[k] + curve.transmittance[k] + curve.emissivity[k], 1.0, 1e-12);
  EXPECT_EQ(ifov::curves_of(leaf, "1"), std::vector<std::size_t>{0});
  EXPECT_THROW(ifov::curves_of(leaf, "99"), ifov::InputError);
  EXPECT_EQ(ifov::material_csv(leaf, ifov::curves_of(leaf)), said("materials 'leaf, aspen' --csv"));
  try {
    ifov::search_materials("asphelt");
    FAIL() << "found";
  } catch (const ifov::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("asphalt"), std::string::npos) << error.what();
  }
  EXPECT_EQ(ifov::document_reference(), said("schema --markdown"));
}

TEST_F(Values, OfScattering) {
  const std::vector<ifov::ScatteringModel> models = ifov::scattering_models();
  const auto rough =
      std::find_if(models.begin(), models.end(), [](const auto& m) { return m.key == "oren_nayar"; });
  ASSERT_NE(rough, models.end());
  ASSERT_EQ(rough->parameters.size(), 1u);
  EXPECT_EQ(rough->parameters[0].value, "angle between 0 and 60 deg, or angle by a map");
  EXPECT_TRUE(rough->parameters[0].required);
  EXPECT_EQ(ifov::scattering_models_list(), said("brdf --list"));
  EXPECT_EQ(ifov::scattering_models_reference(), said("brdf --list --markdown"));

  const ifov::BrdfReport ground = ifov::survey_brdf(scene(), "ground", {.light_rad = {40 * kDegree}});
  EXPECT_EQ(ground.model, "lambertian");
  ASSERT_EQ(ground.lobes.size(), 1u);
  ASSERT_EQ(ground.lobes[0].brdf.size(), ground.view_rad.size());
  for (const double brdf : ground.lobes[0].brdf) EXPECT_NEAR(brdf, 0.3 / M_PI, 1e-7);
  for (const double emissivity : ground.by_angle.emissivity) EXPECT_NEAR(emissivity, 0.7, 1e-7);
  EXPECT_TRUE(ground.by_angle.transmittance.empty());
  EXPECT_TRUE(ground.spectra.empty());

  const ifov::BrdfReport soil =
      ifov::survey_model("rpv", {"k=0.648", "asymmetry=-0.29"},
                         R"({"table": {"wavelength": ["0.4 um", "0.8 um"], "values": [0.05, 0.1]}})",
                         {.wavelength_um = ifov::wavelength_um_of("600nm"), .figure = true});
  EXPECT_EQ(soil.spectrum_um, (std::vector<double>{0.4, 0.8}));
  ASSERT_EQ(soil.spectra.size(), 2u);
  EXPECT_LT(soil.spectra[0].reflectance[0], soil.spectra[0].reflectance[1]);
  // Of rpv the shape depends on the level by the hot spot alone.
  EXPECT_NEAR(soil.by_angle.reflectance[0],
              0.5 * (soil.spectra[0].reflectance[0] + soil.spectra[0].reflectance[1]), 2e-3);
  const std::string tables = said(
      "brdf rpv --set k=0.648 --set asymmetry=-0.29 --at 0.6um --reflectance "
      R"('{"table": {"wavelength": ["0.4 um", "0.8 um"], "values": [0.05, 0.1]}}')");
  EXPECT_EQ(soil.table(), tables);
  EXPECT_THROW(ifov::survey_brdf(scene(), "sky"), ifov::InputError);
  EXPECT_THROW(ifov::survey_brdf(scene(), "ground", {.light_rad = {2.0}}), ifov::InputError);
  EXPECT_THROW(ifov::wavelength_um_of("3 m"), ifov::InputError);
}

TEST_F(Values, FilesAreMadeAnewAndFollowNoLink) {
  std::ofstream(folder_ / "precious") << "mine";
  fs::create_symlink("precious", folder_ / "figure.png");
  ifov::write_file(folder_ / "figure.png", "text");
  EXPECT_FALSE(fs::is_symlink(folder_ / "figure.png"));
  EXPECT_EQ(fs::file_size(folder_ / "precious"), 4u);
  EXPECT_THROW(ifov::write_file("/proc/figure.png", "text"), ifov::SystemError);
}

}  // namespace
}  // namespace test_values
