#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "exposure/solved_surface.h"
#include "studies/temperature/outlined_box.h"
#include "studies/temperature/study_scenes.h"
#include "studies/temperature/temperature_checks.h"
#include "thermal/faces/sky_longwave.h"

namespace ifov::studies {
namespace {

/// So that chance leaves 0.02 K of the mean of estimates that are off by 4 K each.
constexpr int kDraws = 40000, kFaultDraws = 400;

}  // namespace

thermal::OutdoorsSeries planted(const thermal::OutdoorsSeries& series, Fault fault) {
  thermal::OutdoorsSeries wrong = series;
  const auto two_hours = static_cast<std::size_t>(7200.0 / series.step_s),
             a_day = static_cast<std::size_t>(86400.0 / series.step_s);
  for (std::size_t i = 0; i < wrong.rows.size(); ++i) {
    thermal::Outdoors& now = wrong.rows[i];
    const thermal::Outdoors& before = series.rows[i >= two_hours ? i - two_hours : i + a_day - two_hours];
    switch (fault) {
      case Fault::none: break;
      case Fault::no_diffuse_light: now.diffuse_w_m2 = 0.0; break;
      case Fault::wind_of_10_m: now.wind_m_s *= std::log(10.0 / 0.03) / std::log(2.0 / 0.03); break;
      case Fault::local_clock:
        now.sun_azimuth_rad = before.sun_azimuth_rad;
        now.sun_elevation_rad = before.sun_elevation_rad;
        now.direct_w_m2 = before.direct_w_m2;
        now.diffuse_w_m2 = before.diffuse_w_m2;
        break;
      case Fault::sky_as_air:
        now.longwave_w_m2 = thermal::kStefanBoltzmann_w_m2_k4 * std::pow(now.air.temperature_k, 4);
        break;
      case Fault::other_yesterday:
        if (i + a_day < wrong.rows.size()) now.direct_w_m2 = 0.0;
        break;
    }
  }
  return wrong;
}

PlacesOffK pole_shadow(const StudyOptions& options, Fault fault) {
  constexpr OutlinedBox kPole{0.25, 0.25, 5.0};

  const SolvedScenePtr kept = pole_scene(options);
  const SolvedScene& scene = *kept;

  const std::unique_ptr<const exposure::SolvedSurface> other =
      scene.surface_under(0, planted(scene.series(), fault));
  // By its shadow alone: one dimension has nothing beside it.
  const exposure::SolvedSurface asked =
      (fault == Fault::none ? *scene.surface(0) : *other).without_neighbours();
  std::vector<std::pair<double, double>> places_m;  // north of the pole
  for (const double y_m : {0.7, 1.3, 1.9, 2.5, 3.1})
    for (const double x_m : {-1.0, 0.0, 1.0}) places_m.emplace_back(x_m, y_m);
  std::vector<double> expected_k(places_m.size()), found_k(places_m.size());
  parallel_for(static_cast<std::int64_t>(places_m.size()), options.threads, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const auto [x_m, y_m] = places_m[k];
    thermal::Stand stand;
    stand.free_sky = kPole.free_sky(x_m, y_m);
    expected_k[k] = scene.full_k(0, stand, kPole.free_sun(scene.series(), x_m, y_m));
    found_k[k] = mean_estimate_k(asked, scene.from_above(x_m, y_m),
                                 fault == Fault::none ? kDraws : kFaultDraws, options.seed);
  });
  PlacesOffK found;
  double coldest_k = INFINITY, warmest_k = 0.0;
  for (std::size_t k = 0; k < places_m.size(); ++k) {
    found.worst_k = std::max(found.worst_k, std::abs(found_k[k] - expected_k[k]));
    coldest_k = std::min(coldest_k, expected_k[k]);
    warmest_k = std::max(warmest_k, expected_k[k]);
  }
  found.range_k = warmest_k - coldest_k;
  return found;
}

CarTrace car_trace(int left_min, const StudyOptions& options) {
  constexpr OutlinedBox kCar{2.2, 0.9, 1.5};
  constexpr int kCame_min = 530;
  const SolvedScenePtr kept = car_scene(kCame_min, left_min, options), bare = bare_scene(options);
  const SolvedScene &scene = *kept, &minutes = *bare;
  const std::unique_ptr<const exposure::SolvedSurface> never = minutes.surface_under(0, scene.series());
  CarTrace trace;
  for (const auto& [x_m, y_m] : {std::pair{0.0, 0.0}, {2.0, 0.3}, {-1.0, 1.3}}) {
    const std::vector<thermal::Outdoors>& rows = minutes.series().rows;
    std::vector<double> sun(rows.size(), 1.0), sky(rows.size(), 1.0);
    const bool under = std::abs(x_m) < kCar.half_x_m && std::abs(y_m) < kCar.half_y_m;
    const double beside = under ? 0.0 : kCar.free_sky(x_m, y_m);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const double before_min = static_cast<double>(rows.size() - 1 - row);
      // A minute at which it comes or goes is half of both.
      const double there = before_min < kCame_min && before_min > left_min     ? 1.0
                           : before_min == kCame_min || before_min == left_min ? 0.5
                                                                               : 0.0;
      if (under || kCar.is_in(x_m, y_m, to_sun(rows[row]))) sun[row] = 1.0 - there;
      sky[row] = 1.0 - there * (1.0 - beside);
    }
    const double expected_k = minutes.full_k(0, {}, sun, sky);
    const geometry::SurfacePoint point = scene.from_above(x_m, y_m);
    trace.worst_k = std::max(trace.worst_k, std::abs(mean_estimate_k(scene.surface(0)->without_neighbours(),
                                                                     point, kDraws, options.seed) -
                                                     expected_k));
    trace.without_k =
        std::max(trace.without_k, std::abs(mean_estimate_k(*never, point, 100, options.seed) - expected_k));
  }
  return trace;
}

RoofWind roof_wind(bool suburb, const StudyOptions& options, bool blind) {
  const double z0_m = suburb ? 1.0 : 0.03;
  // Of the wind at 10 m over open terrain, by way of that at 60 m, which all terrains share.
  const auto factor = [&](double z_m) {
    return std::log(60.0 / 0.03) / std::log(10.0 / 0.03) * std::log(z_m / z0_m) / std::log(60.0 / z0_m);
  };
  RoofWind found;
  const std::vector<double> heights_m{4.0, 7.0, 12.0, 20.0, 33.0, 50.0};
  const SolvedScenePtr kept = roof_scene(suburb, heights_m, options);
  const SolvedScene& scene = *kept;
  const auto compare = [&](double x_m, double height_m) {
    // Measured at 60 m and asked for there, it is taken as it is.
    thermal::OutdoorsSeries series = scene.series();
    series.anemometer = {60.0, suburb ? thermal::Terrain::suburb : thermal::Terrain::open};
    for (thermal::Outdoors& now : series.rows) now.wind_m_s *= factor(blind ? 2.0 : height_m);
    thermal::Stand stand;
    stand.height_m = 60.0;
    const double expected_k = scene.full_k(0, stand, series, std::vector<double>(series.rows.size(), 1.0));
    const double found_k = mean_estimate_k(*scene.surface(0), scene.from_above(x_m, 0.0), 8, options.seed);
    found.worst_k = std::max(found.worst_k, std::abs(found_k - expected_k));
    found.height_m.push_back(height_m);
    found.roof_k.push_back(found_k);
    found.expected_k.push_back(expected_k);
  };
  compare(-1e4, 2.0);
  for (std::size_t k = 0; k < heights_m.size(); ++k)
    compare(1e4 * static_cast<double>(k + 1) + 6.0, heights_m[k]);
  return found;
}

double closed_room_drift_k(const StudyOptions& options) {
  const SolvedScenePtr kept = room_scene(options);
  const SolvedScene& scene = *kept;
  double worst_k = 0.0;
  for (const math::Vec3& direction :
       {math::Vec3{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.6, 0.0, -0.8}, {0.0, 1.0, 0.0}, {-0.6, 0.0, -0.8}}) {
    const geometry::SurfacePoint wall = scene.met_by({-3.0, 0.5, 4.0}, direction);
    worst_k = std::max(worst_k, std::abs(scene.surface(1)->at(wall, options.seed).kelvin - 290.0));
  }
  return worst_k;
}

}  // namespace ifov::studies
