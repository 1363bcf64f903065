// Temperatures that follow from what the Sun, the sky and the air did: at points of scenes, against each solved in full by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "atmosphere/weather_series.h"
#include "core/error.h"
#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/exposed_point.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "io/document/scene_document.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "session/assembly/surfaces/thermal_assembly.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "session/temperatures/temperature_survey.h"
#include "studies/temperature/outlined_box.h"
#include "transport/spectral_scene.h"

namespace ifov::session::test_solved_temperatures {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPole_m = 0.5, kTop_m = 5.0;  // side and height of the pole about the origin
constexpr studies::OutlinedBox kPoleBox{0.5 * kPole_m, 0.5 * kPole_m, kTop_m};

std::string text_of(const DaysOfJune& weather, const char* time, const std::string& objects,
                    const char* error = "0.8 K") {
  return format(
      R"({{"ifov": 1, "time": "2026-06-21T{}:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "10 min", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}},
            "materials": {{"road": {{"emissivity": 1, "temperature": "solved",
                "thermal": {{"layers": [{{"thickness": "10 cm", "library": "asphalt"}}, {{"thickness": "50 cm", "library": "dry soil"}}],
                            "back": {{"ground": {{"temperature": "12 degC"}}}}, "solar_absorptance": 0.9}}}},
              "brick": {{"emissivity": 1, "temperature": "solved",
                "thermal": {{"layers": [{{"thickness": "20 cm", "library": "brick"}}], "solar_absorptance": 0.7}}}}}},
            "objects": [{}]}},
          "light": {{"sky": {{"none": {{}}}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "0.5 m", "pixels": [24, 16]}}}},
            "channels": [{{"name": "thermal", "top_hat": {{"from": "10 um", "to": "11 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "{}"}}}}}})",
      time, weather.path(), objects, error);
}

const std::string kSlab = R"({"plane": {}, "material": "road"})";
const std::string kPole =
    kSlab +
    format(
        R"(, {{"box": {{"low": ["{0} m", "{0} m", "0 m"], "high": ["{1} m", "{1} m", "{2} m"]}}, "material": "brick"}})",
        -0.5 * kPole_m, 0.5 * kPole_m, kTop_m);

Session load(const std::string& text) {
  return Session::load(io::parse_document(text, "solved.json"), nullptr);
}

geometry::SurfacePoint below(const scene::Scene& scene, double x, double y) {
  const math::Ray down{{x, y, 50.0}, {0.0, 0.0, -1.0}};
  geometry::SurfacePoint hit;
  scene.world->intersect({&down, 1}, {&hit, 1});
  return hit;
}

/// Mean of many estimates.
double mean_k(const scene::SolvedTemperature& of, const geometry::SurfacePoint& point, int draws) {
  double sum = 0.0;
  for (int k = 0; k < draws; ++k) sum += of.at(point, static_cast<std::uint64_t>(k)).kelvin / draws;
  return sum;
}

/// By its shadows alone: what stands about it counts as ground.
exposure::SolvedSurface shaded_alone(const Session& session) {
  return dynamic_cast<const exposure::SolvedSurface&>(*session.parts().scene.solved.at(0))
      .without_neighbours();
}

const scene::SolvedTemperature& of_material(const Session& session, std::size_t material) {
  return *session.parts().scene.solved.at(material);
}

/// What `road` is solved from, put together anew.
struct Road {
  DocumentOutdoors about;
  ThermalMaterial thermal;
  explicit Road(const Session& session)
      : about(outdoors_of_document(session.parts().document, *session.parts().weather)),
        thermal(*assemble_thermal(session.parts().document.sources,
                                  session.parts().document.scene.materials[0],
                                  session.parts().scene.materials[0], 285.0)) {}

  const thermal::OutdoorsSeries& series() const { return about.outdoors.series; }
  double full_k(double free_sky, std::vector<double> visibility) const {
    thermal::Stand stand;
    stand.terrain = about.terrain;
    stand.free_sky = free_sky;
    return thermal::solve_surface(thermal.solid, thermal.skin, stand, series(), thermal.start,
                                  std::move(visibility))
        .history.nodes.back()
        .surface_k;
  }
};

TEST(SolvedTemperatures, ALoneSlabIsAsTheCommandHasIt) {
  const ClearDays weather("solved", 2.5);
  const Session session = load(text_of(weather, "15:00", kSlab));
  const io::TemperatureReport report = survey_temperatures(session.parts().document, {});
  const double expected_k = report.materials.at(0).sunlit.surface_k.back();
  EXPECT_GT(expected_k, 300.0);
  for (const double x : {-3.0, 0.0, 2.5})
    EXPECT_NEAR(of_material(session, 0).at(below(session.parts().scene, x, 1.0), 7).kelvin, expected_k, 0.05);
}

TEST(SolvedTemperatures, WhereAShadowWasAcrossItsPath) {
  const ClearDays weather("solved", 2.5);
  const Session session = load(text_of(weather, "15:00", kPole));
  const Road road(session);
  // The same material under a Sun that stood as on the other side of noon, and without what comes of the sky: both must show.
  thermal::OutdoorsSeries wrong = road.series();
  for (std::size_t i = 0; i < wrong.rows.size(); ++i) {
    const thermal::Outdoors& other = road.series().rows[wrong.rows.size() - 1 - i];
    wrong.rows[i].sun_azimuth_rad = 2.0 * kPi - other.sun_azimuth_rad;
    wrong.rows[i].sun_elevation_rad = other.sun_elevation_rad;
    wrong.rows[i].direct_w_m2 = other.direct_w_m2;
  }
  thermal::OutdoorsSeries dark = road.series();
  for (thermal::Outdoors& now : dark.rows) now.diffuse_w_m2 = 0.0;
  const auto surface_under = [&](const thermal::OutdoorsSeries& series) {
    return exposure::SolvedSurface(std::make_shared<const thermal::SurfaceClasses>(
                                       std::make_shared<const thermal::OutdoorsSeries>(series),
                                       thermal::ClassSurface{road.thermal.solid, road.thermal.skin,
                                                             thermal::Stand{}, road.thermal.start},
                                       1),
                                   exposure::PastScene(*session.parts().scene.world), 0.00465);
  };
  const exposure::SolvedSurface other_day = surface_under(wrong), no_sky = surface_under(dark);
  double coldest = 1e9, warmest = 0.0, off_other_day = 0.0, off_no_sky = 0.0;
  for (const double y : {0.7, 1.3, 1.9, 2.5, 3.1})  // north of the pole
    for (const double x : {-1.0, 0.0, 1.0}) {
      const double expected_k = road.full_k(kPoleBox.free_sky(x, y), kPoleBox.free_sun(road.series(), x, y));
      const geometry::SurfacePoint point = below(session.parts().scene, x, y);
      EXPECT_NEAR(mean_k(shaded_alone(session), point, 8000), expected_k, 0.1) << x << " " << y;
      coldest = std::min(coldest, expected_k);
      warmest = std::max(warmest, expected_k);
      off_other_day = std::max(off_other_day, std::abs(mean_k(other_day, point, 200) - expected_k));
      off_no_sky = std::max(off_no_sky, std::abs(mean_k(no_sky, point, 200) - expected_k));
    }
  EXPECT_GT(warmest - coldest, 2.0);
  EXPECT_GT(off_other_day, 0.5);
  EXPECT_GT(off_no_sky, 0.5);
}

/// Where radiance bends most with temperature: its mean over estimates is that of their mean temperature.
TEST(SolvedTemperatures, RadianceOfEstimatesHasNoBias) {
  const ClearDays weather("solved", 2.5);
  std::string text = text_of(weather, "15:00", kPole);
  for (const auto& [from, to] : {std::pair{"10 um", "3.7 um"}, {"11 um", "3.8 um"}})
    text.replace(text.find(from), std::string(from).size(), to);
  const Session session = load(text);
  const Session::Parts& parts = session.parts();
  const transport::SpectralScene& spectral = *parts.spectral_scene;
  radiometry::SpectrumBlock scratch(3, spectral.node_count());
  const auto planck = [&](double kelvin) {
    std::vector<double> channel(1);
    spectral.nodes().planck_channels(kelvin, channel);
    return channel[0];
  };
  for (const double y : {0.5, 0.7}) {  // north of the pole
    const geometry::SurfacePoint point = below(parts.scene, 0.0, y);
    constexpr int kDraws = 10000;
    double mean_k = 0.0, corrected = 0.0, uncorrected = 0.0;
    for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
      const scene::ResolvedSurface surface = parts.scene.resolve(point, draw);
      const float* light = spectral.emission(surface, {0.0, 0.0, 1.0}, scratch.row(0));
      for (std::size_t n = 0; n < spectral.node_count(); ++n)
        corrected += spectral.nodes().node_weight(n) * static_cast<double>(light[n]) / kDraws;
      mean_k += surface.constituents[0].mapped_temperature_k / kDraws;
      uncorrected += planck(surface.constituents[0].mapped_temperature_k) / kDraws;
    }
    const double per_k = planck(mean_k + 0.5) - planck(mean_k - 0.5);
    EXPECT_NEAR((corrected - planck(mean_k)) / per_k, 0.0, 0.02) << y;
    EXPECT_GT((uncorrected - planck(mean_k)) / per_k, 0.08) << y;
  }
}

TEST(SolvedTemperatures, PointsAtFourHoursAgainstEachSolvedInFull) {
  const ClearDays weather("solved", 2.5);
  double squares = 0.0, bias = 0.0;
  for (const char* time : {"05:00", "09:00", "14:00", "20:00"}) {
    const Session session = load(text_of(weather, time, kPole));
    const TemperatureErrors& errors = *session.parts().temperature_errors;
    EXPECT_EQ(errors.points, 67);  // all of the pole's top besides, which are four: four more are made up
    EXPECT_EQ(errors.made_up, 4);
    EXPECT_LT(errors.worst_k, 1.0) << time;
    EXPECT_LT(errors.step_k, 0.1) << time;
    squares += 0.25 * errors.rms_k * errors.rms_k;
    bias += 0.25 * errors.bias_k;
  }
  EXPECT_LT(std::sqrt(squares), 0.15);
  EXPECT_LT(std::abs(bias), 0.02);
}

TEST(SolvedTemperatures, AClosedRoomOfOneTemperatureStaysThere) {
  const StillDays weather("still");
  const Session session = load(text_of(
      weather, "15:00",
      R"({"box": {"low": ["-5 m", "-5 m", "0 m"], "high": ["5 m", "5 m", "10 m"]}, "material": "brick"})"));
  for (const math::Vec3& direction :
       {math::Vec3{0.0, 0.0, 1.0}, math::Vec3{0.6, 0.0, -0.8}, math::Vec3{0.0, 1.0, 0.0}}) {
    const math::Ray ray{{1.0, 0.5, 5.0}, direction};
    geometry::SurfacePoint hit;
    session.parts().scene.world->intersect({&ray, 1}, {&hit, 1});
    EXPECT_NEAR(of_material(session, 1).at(hit, 3).kelvin, 290.0, 1e-4);
  }
  const math::Ray outside{{0.0, 0.0, 50.0}, {0.0, 0.0, -1.0}};
  geometry::SurfacePoint roof;
  session.parts().scene.world->intersect({&outside, 1}, {&roof, 1});
  EXPECT_LT(of_material(session, 1).at(roof, 3).kelvin, 289.0);  // under a clear sky
}

class OneTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

TEST(SolvedTemperatures, IntervalsHoldWhereShadowsMovedOn) {
  const ClearDays weather("solved", 2.5);
  const Session session = load(text_of(weather, "15:00", kPole));
  const Session::Parts& parts = session.parts();
  // The truth: emission alone (there is no sky), averaged over many points of each pixel.
  constexpr int kAcross = 24, kDown = 16, kPoints = 20;
  std::vector<double> truth;
  std::vector<bool> swept;
  const transport::SpectralScene& spectral = *parts.spectral_scene;
  radiometry::SpectrumBlock scratch(3, spectral.node_count());
  for (int row = 0; row < kDown; ++row)
    for (int column = 0; column < kAcross; ++column) {
      double sum = 0.0, deviation = 0.0;
      for (int k = 0; k < kPoints * kPoints; ++k) {
        const double u = (k % kPoints + 0.5) / kPoints, v = (k / kPoints + 0.5) / kPoints;
        const geometry::SurfacePoint hit =
            below(parts.scene, 0.5 * (column + u) - 6.0, 4.0 - 0.5 * (row + v));
        const scene::ResolvedSurface surface = parts.scene.resolve(hit, 99);
        const float* light = spectral.emission(surface, {0.0, 0.0, 1.0}, scratch.row(0));
        for (std::size_t n = 0; n < spectral.node_count(); ++n)
          sum += spectral.nodes().node_weight(n) * static_cast<double>(light[n]) / (kPoints * kPoints);
        deviation += surface.constituents[0].deviation_k / (kPoints * kPoints);
      }
      truth.push_back(sum);
      swept.push_back(deviation > 0.3);
    }
  int held = 0, of_swept = 0, held_swept = 0, all = 0, held_by_a_quarter = 0;
  for (int seed = 0; seed < 6; ++seed) {
    render::RenderJob job = parts.job();
    job.seed = 50 + static_cast<std::uint64_t>(seed);
    job.nodes = {};  // what paths and edges tell, alone
    render::RenderControl control;
    control.threads = 1;
    OneTile tile;
    render::render_image(job, control, tile);
    for (std::size_t p = 0; p < truth.size(); ++p) {
      const double off = std::abs(static_cast<double>(tile.result.mean[p]) - truth[p]),
                   half = static_cast<double>(tile.result.half_width[p]);
      ++all;
      held += off <= half;
      held_by_a_quarter += off <= 0.25 * half;
      of_swept += swept[p];
      held_swept += swept[p] && off <= half;
    }
  }
  EXPECT_GT(of_swept, 200);
  EXPECT_GE(static_cast<double>(held) / all, 0.93);
  EXPECT_GE(static_cast<double>(held_swept) / of_swept, 0.93);
  EXPECT_LT(static_cast<double>(held_swept) / of_swept, 0.9999);
  // Intervals a quarter as wide would not do: the test can fail.
  EXPECT_LT(static_cast<double>(held_by_a_quarter) / all, 0.93);
}

void expect_error(const std::string& text, const char* part) {
  try {
    load(text);
    FAIL() << "taken: " << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(SolvedTemperatures, SayWhatIsMissing) {
  const ClearDays weather("solved", 2.5);
  const std::string good = text_of(weather, "15:00", kSlab);
  expect_error(replaced(good, format(R"("weather": {{"file": "{}"}},)", weather.path()), ""),
               "a temperature that is solved needs \"weather\"");
  expect_error(replaced(good, R"("time": "2026-06-21T15:00:00Z",)", ""), "needs a \"time\"");
  expect_error(
      replaced(replaced(good, R"("plane": {}, "material": "road")", R"("plane": {}, "material": "bare")"),
               R"("brick": {)", R"("bare": {"emissivity": 0.9, "temperature": "solved"}, "brick": {)"),
      "the temperature of 'bare' is to be solved, and it has neither \"thermal\" nor a reflectance");
  expect_error(
      replaced(replaced(good, R"("plane": {}, "material": "road")", R"("plane": {}, "material": "leaf")"),
               R"("brick": {)",
               R"("leaf": {"reflectance": 0.4, "transmittance": 0.4, "temperature": "solved"}, "brick": {)"),
      "the temperature of 'leaf' cannot be solved: light goes through it, and it is not told to be a sheet of two faces; "
      "give \"thermal\": {\"leaf\": {}}, or layers with \"back\": {\"other_side\": {}}");
}

TEST(SolvedTemperatures, RefuseAnAccuracyThatTheyDoNotHave) {
  const ClearDays weather("solved", 2.5);
  expect_error(
      text_of(weather, "15:00", kPole, "0.01 K"),
      "an accuracy of 0.01 K is asked for, and temperatures that are solved may themselves be off by");
}

// What is known better than that makes the image worth rendering: the rest is named, and rays make no room for it.
TEST(SolvedTemperatures, TellWhatAnAccuracyCannotBeKeptIn) {
  const ClearDays weather("solved", 0.5);
  const Session coarse = load(text_of(weather, "15:00", kPole, "6 K"));
  const TemperatureErrors& errors = *coarse.parts().temperature_errors;
  const double worst_k = errors.half_width_k();
  double best_k = worst_k;
  for (const auto& [material, error] : errors.by_material) best_k = std::min(best_k, error.half_width_k());
  ASSERT_LT(best_k, 0.8 * worst_k);
  EXPECT_EQ(coarse.parts().node_errors[0].given_up, 0.0);
  const std::string asked = format("{:.4f} K", 0.9 * worst_k);
  const Session fine = load(text_of(weather, "15:00", kPole, asked.c_str()));
  const auto& node = fine.parts().node_errors[0];
  EXPECT_GT(node.given_up, 0.1 * node.emitted);
  EXPECT_LT(node.given_up, node.emitted);
  const std::vector<std::string>& told = fine.warnings();
  EXPECT_TRUE(std::any_of(told.begin(), told.end(), [&](const std::string& line) {
    return line.find(format("may themselves be off by more in '{}'", errors.material)) != std::string::npos;
  }));
}

}  // namespace
}  // namespace ifov::session::test_solved_temperatures
