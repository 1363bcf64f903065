// Keys of surface temperatures, their units and messages.
#include <gtest/gtest.h>

#include "core/format.h"
#include "document_maker.h"
#include "geodesy/utc_seconds.h"
#include "io/document/document.h"
#include "io/document/thermal_document.h"

namespace ifov::io::test_document_thermal {
namespace {

const std::string kSoil = "\"soil\": {\"reflectance\": 0.25, \"temperature\": \"20 degC\"}";

std::string with_thermal(const std::string& thermal) {
  return "\"soil\": {\"reflectance\": 0.25, \"thermal\": " + thermal + "}";
}

ThermalDocument read(const std::string& thermal) {
  const Document document =
      parse_document(test::document_with(kSoil, with_thermal(thermal)), "folder/a.json");
  for (const MaterialDocument& material : document.scene.materials)
    if (material.thermal) return *material.thermal;
  ADD_FAILURE() << "no thermal";
  return {};
}

std::string message(const std::string& thermal) {
  const std::string text = test::message_with(kSoil, with_thermal(thermal));
  const std::size_t place = text.find("'scene.materials.soil.thermal");
  return text.substr(place == std::string::npos ? 0 : place,
                     text.find('\n') - (place == std::string::npos ? 0 : place));
}

TEST(DocumentThermal, LayersAndBacks) {
  const ThermalDocument road = read(
      R"({"layers": [{"thickness": "6 cm", "library": "asphalt"}, {"thickness": "1 m", "conductivity": "0.3 W m-1 K-1", "density": "1.6 g/cm3", "specific_heat": "800 J kg-1 K-1"}],
          "back": {"ground": {}}, "roughness": "medium rough", "wetness": "20 %", "resistance": "70 s/m", "power": "60 W m-2"})");
  ASSERT_EQ(road.layers.size(), 2u);
  EXPECT_EQ(road.layers[0].library, "asphalt");
  EXPECT_DOUBLE_EQ(road.layers[0].thickness_m, 0.06);
  EXPECT_DOUBLE_EQ(road.layers[1].density_kg_m3, 1600.0);
  EXPECT_TRUE(road.back.ground && !road.back.ground->temperature_k && !road.back.room && !road.back.held_k);
  EXPECT_EQ(road.roughness, "medium rough");
  EXPECT_DOUBLE_EQ(road.wetness, 0.2);
  EXPECT_DOUBLE_EQ(road.resistance_s_m, 70.0);
  EXPECT_DOUBLE_EQ(road.power_w_m2.constant, 60.0);
  const ThermalDocument wall =
      read(R"({"layers": [{"thickness": "20 cm", "library": "brick"}], "back": {"room": {}}})");
  ASSERT_TRUE(wall.back.room.has_value());
  EXPECT_DOUBLE_EQ(wall.back.room->temperature_k.constant, 293.15);
  EXPECT_DOUBLE_EQ(wall.back.room->conductance_w_m2_k, 7.7);
}

// 1 cal g-1 K-1 is 1 BTU lb-1 degF-1; handbooks: 1 kcal m-1 h-1 K-1 is 1.163 W m-1 K-1, 1 BTU h-1 ft-1 degF-1 1.7307.
TEST(DocumentThermal, UnitsOfHandbooks) {
  const auto therm = [](const std::string& conductivity, const std::string& heat) {
    return *read(R"({"therm": {"density": "487 lb/ft3", "specific_heat": ")" + heat +
                 R"(", "conductivity": ")" + conductivity +
                 R"(", "thickness": "1 mm", "solar_absorption": 0.7, "emissivity": 0.9}})")
                .therm;
  };
  EXPECT_NEAR(therm("43 kcal m-1 h-1 K-1", "0.11 cal g-1 K-1").conductivity_w_m_k, 43.0 * 1.163, 1e-9);
  EXPECT_NEAR(therm("43 kcal m-1 h-1 K-1", "0.11 cal g-1 K-1").specific_heat_j_kg_k, 0.11 * 4186.8, 1e-9);
  EXPECT_NEAR(therm("1 BTU h-1 ft-1 degF-1", "0.11 BTU lb-1 degF-1").specific_heat_j_kg_k, 0.11 * 4186.8,
              1e-6);
  EXPECT_NEAR(therm("1 BTU h-1 ft-1 degF-1", "1 J kg-1 K-1").conductivity_w_m_k, 1.730735, 1e-6);
  EXPECT_NEAR(therm("12 BTU in h-1 ft-2 degF-1", "1 J kg-1 K-1").conductivity_w_m_k, 1.730735, 1e-6);
  EXPECT_NEAR(therm("1 cal cm-1 s-1 K-1", "1 J kg-1 K-1").conductivity_w_m_k, 418.68, 1e-9);
  EXPECT_NEAR(therm("1 W m-1 K-1", "1 J kg-1 K-1").density_kg_m3, 7801.0, 1.0);
  EXPECT_DOUBLE_EQ(therm("1 W m-1 K-1", "1 J kg-1 K-1").exposed_area, 0.5);
}

TEST(DocumentThermal, Messages) {
  EXPECT_EQ(
      message(R"({"layers": [{"thickness": "5 um", "library": "steel"}]})"),
      "'scene.materials.soil.thermal.layers[0].thickness' is the text \"5 um\", expected a length of at least 10 um, "
      "such as \"1 m\" (units: m, km, cm, mm, um, nm, ft, in)");
  EXPECT_EQ(
      message(
          R"({"layers": [{"thickness": "5 mm", "conductivity": "0 W m-1 K-1", "density": "1 kg/m3", "specific_heat": "1 J kg-1 K-1"}]})"),
      "'scene.materials.soil.thermal.layers[0].conductivity' is the text \"0 W m-1 K-1\", expected a conductivity of "
      "heat above 0 W m-1 K-1, such as \"1.4 W m-1 K-1\" (units: W m-1 K-1, kcal m-1 h-1 K-1, cal cm-1 s-1 K-1, BTU h-1 "
      "ft-1 degF-1, BTU in h-1 ft-2 degF-1)");
  EXPECT_NE(
      message(R"({"layers": [{"thickness": "5 mm", "library": "asfalt"}]})").find("did you mean 'asphalt'?"),
      std::string::npos);
  EXPECT_NE(message(R"({"layers": [{"thickness": "5 mm", "conductivity": "1 W m-1 K-1"}]})")
                .find("a conductivity needs 'density' and 'specific_heat' beside it"),
            std::string::npos);
  EXPECT_NE(message(R"({"layers": [{"thickness": "5 mm", "library": "steel"}], "wetness": 1.2})")
                .find("wetness' is the number 1.2, expected"),
            std::string::npos);
  EXPECT_NE(message(R"({"layers": [{"thickness": "5 mm", "library": "steel"}], "roughness": "ruff"})")
                .find("roughness' is the text \"ruff\", expected 'very rough', 'rough'"),
            std::string::npos)
      << message(R"({"layers": [{"thickness": "5 mm", "library": "steel"}], "roughness": "ruff"})");
}

TEST(DocumentThermal, AirGaps) {
  const ThermalDocument wall = read(
      R"({"layers": [{"thickness": "10 cm", "library": "brick"}, {"air_gap": "5 cm"}, {"thickness": "10 cm", "library": "brick"},
                     {"air_gap": "1 in", "heat_flow": "up", "emissivities": [0.9, "5 %"]}], "back": {"room": {}}})");
  ASSERT_EQ(wall.layers.size(), 4u);
  ASSERT_TRUE(!wall.layers[0].air_gap && wall.layers[1].air_gap && wall.layers[3].air_gap);
  EXPECT_DOUBLE_EQ(wall.layers[1].air_gap->thickness_m, 0.05);
  EXPECT_EQ(wall.layers[1].air_gap->heat_flow, "horizontal");
  EXPECT_EQ(wall.layers[1].air_gap->emissivities, (std::vector<double>{0.9, 0.9}));
  EXPECT_DOUBLE_EQ(wall.layers[3].air_gap->thickness_m, 0.0254);
  EXPECT_EQ(wall.layers[3].air_gap->emissivities, (std::vector<double>{0.9, 0.05}));

  const auto of_layers = [](const std::string& layers, const std::string& rest = "") {
    return message(R"({"layers": [)" + layers + "]" + rest + "}");
  };
  const std::string brick = R"({"thickness": "10 cm", "library": "brick"})", air = R"({"air_gap": "2 cm"})";
  const std::string at = "'scene.materials.soil.thermal.layers";
  EXPECT_EQ(of_layers(air + ", " + brick),
            at + "[0]' is an air gap, and the surface is that of a solid; begin with a solid");
  EXPECT_EQ(of_layers(brick + ", " + air + ", " + air + ", " + brick),
            at + "[2]' is an air gap behind another; give one of them, or the sheet between");
  EXPECT_EQ(
      of_layers(brick + ", " + air),
      at +
          "[1]' is an air gap, and no heat passes behind it; give a \"back\" that has a temperature, or leave it out");
  EXPECT_EQ(of_layers(brick + ", " + air, R"(, "back": {"ground": {}})"),
            at + "[1]' is an air gap, and deep ground is what the last layer goes on as; end with a solid");
  EXPECT_EQ(of_layers(brick + R"(, {"air_gap": "40 cm"}, )" + brick),
            at +
                "[1].air_gap' is the text \"40 cm\", expected a length between 1 and 300 mm, such as \"1 m\" "
                "(units: m, km, cm, mm, um, nm, ft, in)");
  EXPECT_EQ(of_layers(brick + R"(, {"air_gap": "4 cm", "heat_flow": "sideways"}, )" + brick),
            at + "[1].heat_flow' is the text \"sideways\", expected 'horizontal', 'up' or 'down'");
  const std::string both =
      test::message_with(kSoil, with_thermal(R"({"layers": [{"air_gap": "4 cm", "library": "brick"}]})"));
  EXPECT_NE(both.find("folder/a.json:9:"), std::string::npos) << both;
  EXPECT_NE(both.find("'library' cannot stand beside 'air_gap' in " + at + "[0]'"), std::string::npos)
      << both;
}

TEST(DocumentThermal, LeavesAndOtherSides) {
  const ThermalDocument leaf = read(R"({"leaf": {}})");
  ASSERT_TRUE(leaf.leaf && leaf.layers.empty() && !leaf.therm);
  EXPECT_DOUBLE_EQ(leaf.leaf->width_m, 0.05);
  EXPECT_DOUBLE_EQ(leaf.leaf->stomatal_mol_m2_s, 0.4);
  EXPECT_FALSE(leaf.leaf->both_faces);
  EXPECT_DOUBLE_EQ(leaf.leaf->water_m, 2e-4);
  const ThermalDocument needle = read(
      R"({"leaf": {"width": "1 mm", "stomatal_conductance": "200 mmol m-2 s-1", "stomata": "both faces", "water": "0.4 mm"}, "emissivity": 0.98})");
  EXPECT_DOUBLE_EQ(needle.leaf->width_m, 1e-3);
  EXPECT_DOUBLE_EQ(needle.leaf->stomatal_mol_m2_s, 0.2);
  EXPECT_TRUE(needle.leaf->both_faces);
  EXPECT_TRUE(read(R"({"layers": [{"thickness": "1 mm", "library": "steel"}], "back": {"other_side": {}}})")
                  .back.other_side);

  EXPECT_NE(
      message(R"({"leaf": {"stomatal_conductance": "12 mol m-2 s-1"}})")
          .find(
              "leaf.stomatal_conductance' is the text \"12 mol m-2 s-1\", expected a conductance of stomata "
              "between 0 and 10 mol m-2 s-1"),
      std::string::npos);
  EXPECT_NE(message(R"({"leaf": {"stomata": "top"}})")
                .find("leaf.stomata' is the text \"top\", expected 'one face' or 'both faces'"),
            std::string::npos);
  EXPECT_EQ(
      message(R"({"leaf": {}, "roughness": "rough"})"),
      "'scene.materials.soil.thermal.roughness' is given beside 'leaf', along whose width the wind goes");
  const std::string wet = test::message_with(kSoil, with_thermal(R"({"leaf": {}, "wetness": 0.5})"));
  EXPECT_NE(wet.find("'wetness'"), std::string::npos) << wet;
  EXPECT_NE(wet.find("'layers'"), std::string::npos) << wet;
  EXPECT_EQ(
      message(
          R"({"therm": {"density": "7.8 g/cm3", "specific_heat": "0.1 cal g-1 K-1", "conductivity": "40 W m-1 K-1", "thickness": "1 mm", "solar_absorption": 0.7, "emissivity": 0.9}, "emissivity": 0.8})"),
      "'scene.materials.soil.thermal.emissivity' is given beside 'therm', which has its own");
}

TEST(DocumentThermal, PowerOverTime) {
  const auto of_power = [](const std::string& table) {
    return R"({"layers": [{"thickness": "1 mm", "library": "steel"}], "power": {"table": [)" + table + "]}}";
  };
  const ThermalDocument hood = read(of_power(
      R"({"time": "2026-06-21T08:00+02:00", "power": "0 W m-2"}, {"time": "2026-06-21T06:30Z", "power": "0.3 kW m-2"})"));
  ASSERT_EQ(hood.power_w_m2.table.size(), 2u);
  EXPECT_DOUBLE_EQ(hood.power_w_m2.table[1].value, 300.0);
  EXPECT_NEAR(geodesy::seconds_after(hood.power_w_m2.table[1].time, hood.power_w_m2.table[0].time), 1800.0,
              1e-6);
  EXPECT_EQ(
      message(of_power(
          R"({"time": "2026-06-21T08:00Z", "power": "0 W m-2"}, {"time": "2026-06-21T07:00Z", "power": "1 W m-2"})")),
      "'scene.materials.soil.thermal.power.table[1].time' is 2026-06-21T07:00:00.000Z, expected a time after "
      "2026-06-21T08:00:00.000Z, which stands before it");
  const std::string no_zone = test::message_with(
      kSoil, with_thermal(of_power(R"({"time": "2026-06-21T08:00", "power": "0 W m-2"})")));
  EXPECT_NE(no_zone.find("zone"), std::string::npos) << no_zone;
  EXPECT_NE(message(of_power("")).find("power.table' is an empty list, expected a list of 1 to 100000"),
            std::string::npos)
      << message(of_power(""));
}

/// What goes over time is a table of the document or a file, wherever a temperature or heat from inside is told.
TEST(DocumentThermal, WhatGoesOverTimeMayBeAFile) {
  const auto wall = [](const std::string& rest) {
    return R"({"layers": [{"thickness": "20 cm", "library": "brick"}], )" + rest + "}";
  };
  const ThermalDocument hall = read(
      wall(R"("back": {"room": {"temperature": {"file": "hall.csv"}}}, "power": {"file": "lamps.csv"})"));
  ASSERT_TRUE(hall.back.room && hall.back.room->temperature_k.file && hall.power_w_m2.file);
  EXPECT_EQ(hall.back.room->temperature_k.file->path, "folder/hall.csv");
  EXPECT_EQ(hall.power_w_m2.file->path, "folder/lamps.csv");
  EXPECT_TRUE(hall.power_w_m2.is_over_time());
  const ThermalDocument heated = read(wall(
      R"("back": {"temperature": {"table": [{"time": "2026-06-21T06:00Z", "temperature": "10 degC"}, {"time": "2026-06-21T07:00Z", "temperature": "21 degC"}]}})"));
  ASSERT_TRUE(heated.back.held_k && heated.back.held_k->table.size() == 2);
  EXPECT_DOUBLE_EQ(heated.back.held_k->table[1].value, 294.15);
  const ThermalDocument told = read(R"({"table": {"file": "skin.csv"}})");
  ASSERT_TRUE(told.held && told.held->file && told.held->table.empty());
  EXPECT_EQ(told.held->file->path, "folder/skin.csv");
  const std::string both = test::message_with(
      kSoil,
      with_thermal(wall(
          R"("power": {"file": "a.csv", "table": [{"time": "2026-06-21T06:00Z", "power": "1 W m-2"}]})")));
  EXPECT_NE(both.find("'file'"), std::string::npos) << both;
  EXPECT_NE(both.find("'table'"), std::string::npos) << both;
  EXPECT_NE(message(wall(R"("back": {"room": {"temperature": "hot"}})"))
                .find("back.room.temperature' is the text \"hot\", expected a temperature"),
            std::string::npos)
      << message(wall(R"("back": {"room": {"temperature": "hot"}})"));
}

TEST(DocumentThermal, TemperaturesThatAreKnown) {
  const ThermalDocument air = read(R"({"air": {}})");
  ASSERT_TRUE(air.held && !air.held->is_over_time() && air.layers.empty());
  const ThermalDocument told = read(
      R"({"table": [{"time": "2026-06-21T06:00Z", "temperature": "20 degC"}, {"time": "2026-06-21T12:00Z", "temperature": "308.15 K"}]})");
  ASSERT_TRUE(told.held && told.held->table.size() == 2);
  EXPECT_DOUBLE_EQ(told.held->table[0].value, 293.15);
  EXPECT_EQ(
      message(
          R"({"table": [{"time": "2026-06-21T06:00Z", "temperature": "20 degC"}, {"time": "2026-06-21T06:00Z", "temperature": "21 degC"}]})"),
      "'scene.materials.soil.thermal.table[1].time' is 2026-06-21T06:00:00.000Z, expected a time after "
      "2026-06-21T06:00:00.000Z, which stands before it");
  EXPECT_EQ(message(R"({"air": {}, "power": "60 W m-2"})"),
            "'scene.materials.soil.thermal.power' has no part where it is told how warm the surface is");
  const std::string both = test::message_with(kSoil, with_thermal(R"({"air": {}, "leaf": {}})"));
  EXPECT_NE(both.find("'air'"), std::string::npos) << both;
  EXPECT_NE(both.find("'leaf'"), std::string::npos) << both;
}

TEST(DocumentThermal, GivenAndSolvedIsOneTooMany) {
  const std::string text = test::message_with(
      kSoil,
      "\"soil\": {\"reflectance\": 0.25, \"temperature\": \"20 degC\", \"thermal\": {\"layers\": [{\"thickness\": \"1 m\", \"library\": \"dry soil\"}]}}");
  EXPECT_NE(text.find("a 'temperature' is given, and 'thermal' to solve for one; give one of them"),
            std::string::npos)
      << text;
}

TEST(DocumentThermal, SolvedIsATemperature) {
  const char* const layers =
      "\"thermal\": {\"layers\": [{\"thickness\": \"1 m\", \"library\": \"dry soil\"}]}";
  const Document document = parse_document(
      test::document_with(
          kSoil, format("\"soil\": {{\"reflectance\": 0.25, \"temperature\": \"solved\", {}}}", layers)),
      "folder/a.json");
  int solved = 0;
  for (const MaterialDocument& material : document.scene.materials)
    solved += material.temperature &&
              std::holds_alternative<SolvedTemperatureDocument>(material.temperature->value);
  EXPECT_EQ(solved, 1);
  const std::string text =
      test::message_with(kSoil, "\"soil\": {\"reflectance\": 0.25, \"temperature\": \"solfed\"}");
  EXPECT_NE(
      text.find(
          "temperature' is the text \"solfed\", expected a temperature of at least 0 K, such as \"20 degC\" "
          "(units: K, degC, degF), or \"solved\""),
      std::string::npos)
      << text;
  const std::string air =
      test::message_with(kSoil, "\"soil\": {\"reflectance\": 0.25, \"temperature\": \"air\"}");
  EXPECT_NE(
      air.find(
          "temperature' is the text \"air\": of what is as warm as the air it is \"solved\", and the material has "
          "\"thermal\": {\"air\": {}}"),
      std::string::npos)
      << air;
}

TEST(DocumentThermal, TemperaturesAreSolvedSo) {
  const Document document = parse_document(
      test::document_with(
          "\"ifov\": 1,",
          "\"ifov\": 1, \"temperatures\": {\"spin_up\": \"36 h\", \"step\": \"15 min\", \"terrain\": \"suburb\"},"),
      "folder/a.json");
  EXPECT_DOUBLE_EQ(document.temperatures->spin_up_s, 129600.0);
  EXPECT_DOUBLE_EQ(document.temperatures->step_s, 900.0);
  EXPECT_EQ(document.temperatures->terrain, "suburb");
  EXPECT_FALSE(document.temperatures->repeat_first_day);
  EXPECT_NE(test::message_with("\"ifov\": 1,", "\"ifov\": 1, \"temperatures\": {\"step\": \"7 min\"},")
                .find("whole number of steps"),
            std::string::npos);
}

}  // namespace
}  // namespace ifov::io::test_document_thermal
