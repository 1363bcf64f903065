#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include "atmosphere/weather_series.h"
#include "figure_data.h"
#include "geodesy/sun_position.h"
#include "geodesy/utc_time.h"
#include "thermal/linear_kernel.h"
#include "thermal/outdoors_series.h"
#include "thermal/solid.h"
#include "thermal/surface_solution.h"

namespace ifov::figures {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr geodesy::Geodetic kPlace{52.0 * kDegree, 0.0, 0.0};

/// A clear day of June by hand: global irradiance by the Sun's elevation as Haurwitz (1945), J. Meteorol. 2, 154, has it.
atmosphere::WeatherSeries clear_day() {
  using enum atmosphere::WeatherQuantity;
  atmosphere::WeatherSeries::Knots knots;
  const auto add = [&](atmosphere::WeatherQuantity quantity, double time_s, double value) {
    knots[static_cast<std::size_t>(quantity)].push_back({time_s, value});
  };
  const geodesy::UtcTime begin = geodesy::parse_utc("2026-06-21T00:00:00Z");
  for (int quarter = 0; quarter <= 96; ++quarter) {
    const double time_s = atmosphere::seconds_of(begin) + quarter * 900.0;
    const double phase = 2.0 * std::numbers::pi * (quarter / 4.0 - 15.0) / 24.0;
    const double sine =
        std::sin(geodesy::sun_position({begin.jd1, begin.jd2 + quarter / 96.0}, kPlace).elevation_rad);
    add(global_irradiance, time_s, sine > 0.0 ? 1098.0 * sine * std::exp(-0.059 / sine) : 0.0);
    add(air_temperature_k, time_s, 290.65 + 5.5 * std::cos(phase));
    add(dew_point_k, time_s, 282.15);
    add(wind_speed_m_s, time_s, 2.5 + std::cos(phase));
  }
  return {{"by hand", kPlace.latitude_rad, kPlace.longitude_rad, kPlace.height_m}, std::move(knots)};
}

}  // namespace

void print_temperatures() {
  const thermal::Span span{
      .end = geodesy::parse_utc("2026-06-22T00:00:00Z"), .step_s = 30.0, .repeat_first_day = true};
  const thermal::OutdoorsSeries series = thermal::outdoors_of(clear_day(), kPlace, span).series;
  const std::size_t rows = series.rows.size(), a_day = 2880, shown = rows - 1 - a_day, every = 20;
  const auto hour = [](std::size_t steps) { return static_cast<double>(steps) / 120.0; };
  for (std::size_t row = 0; row <= a_day; row += every)
    std::printf("air %.4f %.3f\n", hour(row), series.rows[shown + row].air.temperature_k);
  // Solids of data/thermal/materials.txt, with the same skin.
  thermal::Skin skin;
  skin.solar_absorptance = 0.7;
  skin.emissivity = 0.93;
  skin.roughness = thermal::Roughness::medium_rough;
  const auto print = [&](const char* name, const thermal::SolidLayer& layer) {
    for (const double visible : {1.0, 0.0}) {
      const thermal::SurfaceSolution solution =
          solve_surface({{layer}, thermal::Insulated{}}, skin, {}, series, thermal::Start::steady,
                        std::vector<double>(rows, visible));
      for (std::size_t row = 0; row <= a_day; row += every)
        std::printf("temperature %s %g %.4f %.3f\n", name, visible, hour(row),
                    solution.surface_k(shown + row));
      if (visible == 0.0) continue;
      // What an hour ago is worth at 15 h, as a density over time.
      const std::size_t now = shown + std::size_t{15} * 120;
      const std::vector<double> kernel =
          linear_kernel(solution.cells, solution.history, solution.node_of_row(now));
      for (std::size_t before = 6; before < now; before += 1 + before / 20)
        std::printf("kernel %s %.4f %.6e\n", name, hour(before),
                    kernel[solution.node_of_row(now - before)] * 3600.0 / span.step_s);
    }
  };
  print("concrete", {0.2, 2.0, 2400.0, 1000.0});
  print("steel", {0.001, 50.0, 7800.0, 450.0});
}

}  // namespace ifov::figures
