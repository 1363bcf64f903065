// Light that a picture lacks is either there after all or warned of; and what glows has nodes for it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/format.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "radiometry/planck.h"
#include "session/loaded/parts.h"
#include "session/messages.h"
#include "session/session.h"
#include "transport/spectral_scene.h"

namespace ifov::session::test_light_left_out {
namespace {

struct Messages final : LogSink {
  void info(const std::string& message) override { infos += message + "\n"; }
  void warn(const std::string& message) override { warnings += message + "\n"; }
  std::string infos, warnings;
};

void expect_in(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

constexpr const char* kPlane = R"({"materials": {"grey": {"reflectance": 0.5}},
                                   "objects": [{"plane": {}, "material": "grey"}]})";
constexpr const char* kSun = R"("sun": {"point": {"zenith": "30 deg", "azimuth": "90 deg"}})";
constexpr const char* kRed = R"({"name": "red", "monochromatic": {"at": "0.65 um"}})";

std::string document(const std::string& scene, const std::string& light, const std::string& more = "",
                     const std::string& channels = kRed) {
  return format(
      R"({{"ifov": 1, "scene": {}, "light": {{{}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [8, 8]}}}}, "channels": [{}]}}{}}})",
      scene, light, channels, more);
}

std::string warnings_of(const std::string& text) {
  Messages log;
  Session::load(io::parse_document(text, "left_out.json"), &log);
  return log.warnings;
}

TEST(LightLeftOut, NothingIsSaidWhereNothingIs) {
  EXPECT_EQ(
      warnings_of(document(kPlane, std::string(kSun) + R"(, "sky": {"radiance": "20 W m-2 sr-1 um-1"})")),
      "");
  EXPECT_EQ(warnings_of(document(kPlane, std::string(kSun) + R"(, "sky": {"none": {}})")), "");
}

TEST(LightLeftOut, ASunOnOrBelowTheHorizon) {
  EXPECT_EQ(
      warnings_of(document(kPlane, R"("sun": {"point": {"zenith": "90 deg", "azimuth": "90 deg"}},
                                             "sky": {"radiance": "20 W m-2 sr-1 um-1"})")),
      "the Sun stands 0.0 deg below the horizon: it lights nothing, and only a modelled atmosphere has twilight\n");
  const std::string place =
      std::string(R"({"origin": {"latitude": "50 deg", "longitude": "10 deg"}, )") + (kPlane + 1);
  const std::string warned = warnings_of(
      document(place, R"("sun": {"disc": {}}, "sky": {"none": {}})", R"(, "time": "2024-06-20T23:25:00Z")"));
  // 90 deg - 50 deg - 23.4 deg at local midnight.
  EXPECT_EQ(
      warned,
      "the Sun stands 16.6 deg below the horizon: it lights nothing, and only a modelled atmosphere has twilight\n"
      "nothing shines in 'red': neither Sun nor sky has light there, and nothing that is seen emits; the "
      "radiance will be 0\n");
}

TEST(LightLeftOut, NoSky) {
  EXPECT_EQ(
      warnings_of(document(kPlane, kSun)),
      "there is no sky: what the Sun does not reach is lit by other surfaces alone. Give light.sky, or an "
      "atmosphere; \"sky\": {\"none\": {}} says that this is meant\n");
  EXPECT_EQ(
      warnings_of(document(R"({"materials": {"grey": {"reflectance": 0.5, "temperature": "300 K"}},
                                     "objects": [{"plane": {}, "material": "grey"}]})",
                           "", "", R"({"name": "tir", "monochromatic": {"at": "10 um"}})")),
      "there is no sky: surfaces reflect a sky at 0 K. Give light.sky, or an atmosphere; \"sky\": {\"none\": {}} "
      "says that this is meant\n");
}

// A disc that fills the middle of the picture: what lies beside it looks past it.
TEST(LightLeftOut, BlackSurroundings) {
  const std::string disc = R"({"materials": {"grey": {"reflectance": 0.5}},
                               "objects": [{"disk": {"center": ["0 m", "0 m", "5 m"], "normal": [0, 0, 1], "radius": "2 m"}, "material": "grey"}]})";
  const std::string light = std::string(kSun) + R"(, "sky": {"radiance": "20 W m-2 sr-1 um-1"})";
  const std::string warned = warnings_of(document(disc, light));
  expect_in("light.surroundings are not declared and taken as black at 0 K: ", warned);
  expect_in(" % of the picture sees them, and ", warned);
  EXPECT_EQ(warnings_of(document(disc, light + R"(, "surroundings": {"reflectance": 0.0})")), "");
}

TEST(LightLeftOut, ReflectionsBeyondTheDepth) {
  const std::string light = std::string(kSun) + R"(, "sky": {"radiance": "20 W m-2 sr-1 um-1"})";
  EXPECT_EQ(
      warnings_of(document(kPlane, light, R"(, "sampling": {"single": {}, "max_depth": 2})")),
      "max_depth 2: light that is reflected more often is left out, and no interval knows of it. Between surfaces like "
      "'grey', which reflects up to 50 %, that is up to 25 % of it; without max_depth nothing is left out\n");
  EXPECT_EQ(warnings_of(document(kPlane, light, R"(, "sampling": {"single": {}, "max_depth": 12})")), "");
}

TEST(LightLeftOut, SurfacesWithoutATemperatureFrom3MicrometresOn) {
  expect_in("there are thermal channels, and no temperature for 'grey': what has none emits nothing",
            warnings_of(document(kPlane, R"("sky": {"none": {}})", "",
                                 R"({"name": "m", "monochromatic": {"at": "3.9 um"}})")));
}

/// Under an atmosphere, without surroundings or with.
Session in_air(const std::string& surroundings, Messages& log) {
  return Session::load(
      io::parse_document(
          document(
              R"({"materials": {"grey": {"reflectance": 0.5}}, "objects": [{"plane": {}, "material": "grey"}]})",
              R"("sun": {"disc": {"zenith": "40 deg", "azimuth": "150 deg"}})" + surroundings,
              R"(, "atmosphere": {"profile": "US standard 1976"}, "sampling": {"single": {}})",
              R"({"name": "450", "gaussian": {"center": "450 nm", "fwhm": "10 nm"}},
                      {"name": "865", "gaussian": {"center": "865 nm", "fwhm": "20 nm"}})"),
          "air.json"),
      &log);
}

/// Of a level surface of 0.5, at the sensor.
double at_sensor(const Session& session, std::size_t channel) {
  return session.parts().spectral_scene->path_radiance()[channel] +
         0.5 * session.parts().spectral_scene->white_reflected()[channel];
}

// An even field under air is as bright as with surroundings like it; black ones would take up to a third away.
TEST(LightLeftOut, SurroundingsUnderAnAtmosphereAreTheGroundInThePicture) {
  Messages log, other;
  const Session assumed = in_air("", log),
                declared = in_air(R"(, "surroundings": {"reflectance": 0.5})", other),
                black = in_air(R"(, "surroundings": {"reflectance": 0.0})", other);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_NEAR(at_sensor(assumed, c) / at_sensor(declared, c), 1.0, 1e-6) << c;
    EXPECT_LT(at_sensor(black, c) / at_sensor(declared, c), 0.9) << c;
  }
  const std::string said =
      "surroundings: none declared; taken as the mean of the ground in the picture (100 % 'grey'), which emits nothing";
  expect_in(said, log.infos);
  expect_in(said, describe(assumed.parts()));
  EXPECT_EQ(log.warnings.find("surroundings"), std::string::npos) << log.warnings;
}

class WarmMixture : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_left_out_{}", getpid());
    std::filesystem::create_directories(folder_);
    std::ofstream mixture(folder_ / "mix.img", std::ios::binary);
    const float fractions[] = {0.4f, 0.6f};
    mixture.write(reinterpret_cast<const char*>(fractions), sizeof fractions);
    std::ofstream(folder_ / "mix.hdr")
        << "ENVI\nsamples = 1\nlines = 1\nbands = 2\ndata type = 4\ninterleave = bsq\nbyte order = 0\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A mixture of two materials with one temperature map, in one channel.
  Session warm(double temperature_k, double to_um) const {
    std::ofstream(folder_ / "t.asc") << "ncols 1\nnrows 1\nxllcorner -50\nyllcorner -50\ncellsize 100\n"
                                     << temperature_k << "\n";
    const auto material = [](const char* reflectances) {
      return format(
          R"({{"reflectance": {{"table": {{"wavelength": ["2.5 um", "3.6 um", "3.9 um", "5.5 um"], "values": {}}},
                               "outside": "extend"}},
               "temperature": {{"map": {{"file": "t.asc", "unit": "K", "low_left": ["-50 m", "-50 m"],
                                         "size": ["100 m", "100 m"]}}}}}})",
          reflectances);
    };
    return Session::load(
        io::parse_document(
            document(
                format(
                    R"({{"materials": {{"a": {}, "b": {}}}, "objects": [{{"plane": {{}}, "material": {{"mixture":
                                  {{"file": "mix.img", "low_left": ["-50 m", "-50 m"], "size": ["100 m", "100 m"],
                                    "materials": ["a", "b"]}}}}}}]}})",
                    material("[0.05, 0.05, 0.9, 0.95]"), material("[0.05, 0.05, 0.95, 0.95]")),
                R"("sky": {"none": {}})", "",
                format(R"({{"name": "mwir", "top_hat": {{"from": "3 um", "to": "{} um"}}}})", to_um)),
            (folder_ / "warm.json").string()),
        nullptr);
  }
  std::filesystem::path folder_;
};

/// What the channel shows of what the mixture emits, by nodes, over integration in small steps.
double shown(const Session& session, const radiometry::SpectralNodes& nodes, double temperature_k,
             double to_um) {
  const Session::Parts& parts = session.parts();
  const transport::SpectralScene spectral(parts.scene, nodes);
  const math::Ray ray{{0.5, 0.5, 10.0}, {0.0, 0.0, -1.0}};
  geometry::SurfacePoint hit;
  parts.scene.world->intersect({&ray, 1}, {&hit, 1});
  const scene::ResolvedSurface surface = parts.scene.resolve(hit);
  EXPECT_EQ(surface.count, 2u);
  radiometry::SpectrumBlock scratch(3, nodes.node_count());
  const float* emitted = spectral.emission(surface, -ray.direction, scratch.row(0));
  float found = 0.0f;
  nodes.to_channels(emitted, &found);
  double expected = 0.0;
  constexpr int kSteps = 20000;
  for (int k = 0; k < kSteps; ++k) {
    const double um = 3.0 + (to_um - 3.0) * (k + 0.5) / kSteps;
    double emissivity = 0.0;
    for (const scene::Constituent& part : surface)
      emissivity += part.weight * (1.0 - parts.scene.materials[part.material].reflectance.at(um));
    expected += emissivity * radiometry::planck_w_m2_sr_um(um, temperature_k) / kSteps;
  }
  return found / expected;
}

// Nodes are chosen for what emits, mixtures with temperature maps among it. With those of a scene that emits nothing the
// same surface is percents off: the planted fault.
TEST_F(WarmMixture, HasNodesForWhatItEmits) {
  for (const auto& [temperature_k, to_um, least_fault] :
       {std::tuple{330.0, 5.0, 0.01}, {700.0, 14.0, 0.05}}) {
    const Session session = warm(temperature_k, to_um);
    const Session::Parts& parts = session.parts();
    ASSERT_TRUE(parts.scene.temperatures());
    EXPECT_NEAR(parts.scene.temperatures()->hottest_k, temperature_k, 1e-3);
    EXPECT_NEAR(shown(session, *parts.nodes, temperature_k, to_um), 1.0, 1e-3);
    std::vector<radiometry::Spectrum> surfaces;
    for (const materials::Material& material : parts.scene.materials)
      surfaces.push_back(material.reflectance);
    const auto cold = radiometry::SpectralNodes::build(parts.channels, radiometry::Spectrum(), surfaces,
                                                       {.coldest_k = 0.0, .hottest_k = 0.0});
    const double fault = shown(session, cold, temperature_k, to_um);
    RecordProperty(format("fault_{:.0f}_k", temperature_k), std::to_string(fault));
    EXPECT_GT(std::abs(fault - 1.0), least_fault);
  }
}

}  // namespace
}  // namespace ifov::session::test_light_left_out
