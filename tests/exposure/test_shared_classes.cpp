// Materials that are the same to heat share their classes; one that differs in anything that heat depends on has its own.
#include <gtest/gtest.h>

#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/solved_surface.h"
#include "io/document/document.h"
#include "scene/scene.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_shared_classes {
namespace {

constexpr const char* kLayer =
    R"({"thickness": "5 cm", "conductivity": "0.8 W m-1 K-1", "density": "2000 kg m-3", "specific_heat": "900 J kg-1 K-1"})";
constexpr const char* kRoom = R"("back": {"room": {"temperature": "290 K", "conductance": "5 W m-2 K-1"}}, )";

std::string thermal(const std::string& rest, const std::string& layers = kLayer,
                    const std::string& back = kRoom) {
  return format(R"("thermal": {{"layers": [{}], {}"solar_absorptance": 0.6, "emissivity": 0.9{}}})", layers,
                back, rest);
}

TEST(SharedClasses, AreThoseOfMaterialsThatAreTheSameToHeat) {
  const ClearDays weather("shared", 2.5);
  const auto layer = [](const char* thickness, const char* conductivity, const char* density,
                        const char* heat) {
    return format(
        R"({{"thickness": "{}", "conductivity": "{} W m-1 K-1", "density": "{} kg m-3", "specific_heat": "{} J kg-1 K-1"}})",
        thickness, conductivity, density, heat);
  };
  const auto skin = [&](const char* absorptance, const char* emissivity) {
    return format(
        R"("thermal": {{"layers": [{}], "back": {{"room": {{"temperature": "290 K", "conductance": "5 W m-2 K-1"}}}}, "solar_absorptance": {}, "emissivity": {}}})",
        kLayer, absorptance, emissivity);
  };
  const auto therm = [](const char* area) {
    return format(
        R"("thermal": {{"therm": {{"density": "2 g/cm3", "specific_heat": "0.2 cal g-1 K-1", "conductivity": "1 kcal m-1 h-1 K-1", "thickness": "2 cm", "solar_absorption": 0.6, "emissivity": 0.9, "exposed_area": {}}}}})",
        area);
  };
  // The first two are the same to heat, and look another; each of the others differs from all before it by one thing.
  const std::vector<std::string> materials{
      thermal(""),
      thermal(""),
      thermal("", layer("6 cm", "0.8", "2000", "900")),
      thermal("", layer("5 cm", "0.9", "2000", "900")),
      thermal("", layer("5 cm", "0.8", "2100", "900")),
      thermal("", layer("5 cm", "0.8", "2000", "950")),
      thermal("", format("{}, {}", kLayer, kLayer)),
      thermal("", kLayer, R"("back": {"room": {"temperature": "291 K", "conductance": "5 W m-2 K-1"}}, )"),
      thermal("", kLayer, R"("back": {"room": {"temperature": "290 K", "conductance": "6 W m-2 K-1"}}, )"),
      thermal("", kLayer, R"("back": {"temperature": "290 K"}, )"),
      thermal("", kLayer, ""),
      thermal("", kLayer, R"("back": {"ground": {"temperature": "290 K"}}, )"),
      skin("0.61", "0.9"),
      skin("0.6", "0.91"),
      thermal(R"(, "roughness": "smooth")"),
      thermal(R"(, "wetness": 0.3)"),
      thermal(R"(, "wetness": 0.3, "resistance": "70 s/m")"),
      thermal(R"(, "power": "20 W m-2")"),
      therm("0.5"),
      therm("0.6"),
      thermal("", R"({"thickness": "5 cm", "library": "fresh snow"})"),
  };
  std::string named, objects;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    named += format(R"({}"m{}": {{"reflectance": {}, "temperature": "solved", {}}})", k > 0 ? ", " : "", k,
                    k == 1 ? 0.3 : 0.2, materials[k]);
    objects += format(
        R"({}{{"box": {{"low": ["{} m", "0 m", "0 m"], "high": ["{} m", "1 m", "1 m"]}}, "material": "m{}"}})",
        k > 0 ? ", " : "", 2 * k, 2 * k + 1, k);
  }
  const Session session = Session::load(
      io::parse_document(format(
                             R"({{"ifov": 1, "time": "2026-06-21T15:00:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "1 h", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}}, "materials": {{{}}}, "objects": [{}]}},
          "light": {{"sky": {{"temperature": "255 K"}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [2, 2]}}}},
            "channels": [{{"name": "thermal", "monochromatic": {{"at": "10 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "50 K"}}}}}})",
                             weather.path(), named, objects),
                         "shared.json"),
      nullptr);
  const auto classes_of = [&](std::size_t material) {
    return dynamic_cast<const exposure::SolvedSurface&>(*session.parts().scene.solved.at(material))
        .shared_classes();
  };
  EXPECT_EQ(classes_of(1), classes_of(0));
  for (std::size_t k = 2; k < materials.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      EXPECT_NE(classes_of(k), classes_of(other)) << k << " " << other;
}

}  // namespace
}  // namespace ifov::session::test_shared_classes
