// Surface temperatures as a program asks for them: what `ifov temperature` says.
#include <cmath>

#include "facade_fixture.h"

namespace facade_test::test_temperature {
namespace {

TEST_F(Facade, TemperaturesOfMaterials) {
  std::string rows = "time,air_temperature_c,wind_speed_m_s,global_irradiance_w_m2,longwave_down_w_m2\n";
  for (int hour = 0; hour < 24; ++hour) {
    const double height = std::max(0.0, -std::cos(hour * M_PI / 12.0));
    rows += "2026-03-20T" + std::string(hour < 10 ? "0" : "") + std::to_string(hour) + ":00:00Z,8,2," +
            std::to_string(600.0 * height) + ",300\n";
  }
  std::ofstream(folder_ / "weather.csv") << rows;
  const std::string text = replaced(
      replaced(
          kScene, "\"ball\": {\"reflectance\": 0.6, \"temperature\": \"35 degC\"}",
          R"("ball": {"reflectance": 0.6, "thermal": {"layers": [{"thickness": "2 mm", "library": "steel"}]}})"),
      "\"scene\": {",
      R"("time": "2026-03-20T23:00:00Z", "weather": {"file": "weather.csv"}, "temperatures": {"repeat_first_day": true, "step": "15 min"},
      "scene": {"origin": {"latitude": "45 deg", "longitude": "0 deg"}, )");
  std::ofstream(folder_ / "day.json") << text;
  const ifov::Document document = ifov::Document::read(folder_ / "day.json");

  const ifov::TemperatureReport report = ifov::survey_temperatures(document);
  ASSERT_EQ(report.materials.size(), 1u);  // the ground says nothing of what it is made of
  EXPECT_EQ(report.materials[0].name, "ball");
  ASSERT_EQ(report.time_s.size(), 97u);
  ASSERT_EQ(report.materials[0].sunlit_k.size(), 97u);
  EXPECT_GT(report.materials[0].sunlit_k[52], report.materials[0].shaded_k[52] + 2.0);  // at noon
  EXPECT_LT(std::abs(report.materials[0].unaccounted), 1e-6);
  EXPECT_NE(report.notes.back().find("left out"), std::string::npos);
  const Ran printed = program("temperature " + (folder_ / "day.json").string() + " --materials");
  EXPECT_EQ(printed.code, 0) << printed.err;
  EXPECT_EQ(printed.out, report.table());
  EXPECT_NE(report.csv().find("\n\"ball\",shaded,"), std::string::npos);
  EXPECT_THROW(ifov::survey_temperatures(document, {.materials = {"ground"}}), ifov::InputError);
  EXPECT_THROW(ifov::survey_temperatures(scene()), ifov::InputError);
  // The scene's points are of materials with temperatures of their own, unless these are solved.
  EXPECT_THROW(ifov::point_temperature(document, {}), ifov::InputError);
  if (draws_figures()) {
    EXPECT_EQ(report.figure().substr(1, 3), "PNG");
  }
}

}  // namespace
}  // namespace facade_test::test_temperature
