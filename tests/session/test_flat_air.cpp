#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "core/format.h"
#include "io/document/document.h"
#include "session/assembly/atmosphere/flat_air.h"
#include "session/session.h"

namespace ifov::session {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Warnings final : LogSink {
  std::string all;
  void info(const std::string&) override {}
  void warn(const std::string& text) override { all += text + "\n"; }
};

std::string warned(double view_deg, double sun_deg, double channel_um = 0.65) {
  Warnings log;
  const Session session = Session::load(
      io::parse_document(format(R"({{"ifov": 1, "scene": {{"materials": {{"grey": {{"reflectance": 0.3}}}},
                   "objects": [{{"plane": {{}}, "material": "grey"}}]}},
                 "light": {{"sun": {{"disc": {{"zenith": "{} deg", "azimuth": "150 deg"}}}},
                            "surroundings": {{"reflectance": 0.3}}}},
                 "atmosphere": {{"profile": "US standard 1976", "aerosol": {{"type": "none"}}}},
                 "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [1, 1], "view_zenith": "{} deg"}}}},
                   "channels": [{{"name": "red", "gaussian": {{"center": "{} um", "fwhm": "20 nm"}}}}]}},
                 "sampling": {{"single": {{}}}}}})",
                                sun_deg, view_deg, channel_um),
                         "flat.json"),
      &log);
  return log.all;
}

TEST(FlatAir, IsWarnedOfWhereTheEarthIsRound) {
  EXPECT_EQ(warned(74.0, 79.0), "");
  EXPECT_EQ(warned(78.0, 40.0, 10.5).find("lines of sight"),
            std::string::npos);  // nothing is scattered there
  EXPECT_EQ(
      warned(78.0, 40.0),
      "lines of sight reach 78 deg from the nadir, and layers of air are flat for them: about the round Earth "
      "the path's scattered light at 80 deg is 4 % less with the Sun 60 deg from the zenith, 6 % at 84 deg and "
      "17 % at 89 deg; no half-width holds that\n");
  EXPECT_EQ(
      warned(0.0, 87.5),
      "the Sun stands 2.5 deg above the horizon, and all of a line of sight has this height of it: with the Sun "
      "at 1 deg the sky 80 deg from the zenith is up to 27 % too bright; no half-width holds that\n");
  EXPECT_TRUE(flat_air_warnings(75.0 * kDegree, 100.0, 80.0 * kDegree).empty());
  EXPECT_TRUE(flat_air_warnings(0.0, 100.0, std::nullopt).empty());
  EXPECT_EQ(flat_air_warnings(79.0 * kDegree, 100.0, 85.0 * kDegree, "Moon").size(), 2u);
  EXPECT_TRUE(flat_air_warnings(80.0 * kDegree, 0.5, 40.0 * kDegree).empty());  // from a low aircraft
}

}  // namespace
}  // namespace ifov::session
