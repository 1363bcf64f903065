#include <cmath>
#include <new>

#include "facade_fixture.h"

namespace facade_test::test_facade {
namespace {

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

}  // namespace
}  // namespace facade_test::test_facade
