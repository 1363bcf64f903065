#pragma once

#include <optional>
#include <string>
#include <vector>

#include "thermal/fluxes.h"

namespace ifov::io {

/// How warm materials were over a day, or one point of a scene: what `ifov temperature` tells.
struct TemperatureReport {
  std::string document;  ///< its name
  std::vector<std::string>
      notes;  ///< place, weather, how the surface stands, and what stood in for what: a line each

  std::vector<double> time_s;  ///< of each row: seconds of UTC since 1970
  std::vector<double> air_k;   ///< the air at each

  /// A surface in the Sun or out of it.
  struct Day {
    std::vector<double> surface_k;        ///< at each row
    std::vector<thermal::Fluxes> fluxes;  ///< likewise
  };
  struct Material {
    std::string name;
    std::vector<std::string> description;  ///< what it is made of, a line each
    Day sunlit, shaded;
    double unaccounted =
        0.0;  ///< heat that is lost in the sunlit solution (a point's own), over what came in
    /// Of a point of a scene: its own, in the Sun when that reached it.
    struct Here {
      Day day;
      std::vector<double> sun_seen,
          free_sky;  ///< at each row: shares of the Sun's disc, and of the sky above its horizon
    };
    std::optional<Here> here;
  };
  std::vector<Material> materials;

  /// When one sunlit surface becomes warmer than another.
  struct Crossover {
    double time_s = 0.0;
    std::size_t warmer = 0, cooler = 0;  ///< from then on; materials by their position
  };
  std::vector<Crossover> crossovers;  ///< in order of time
};

/// Finds the crossovers of all pairs, linear between rows.
std::vector<TemperatureReport::Crossover> crossovers_of(const TemperatureReport& report);

/// Tables for a terminal: each material hour by hour, with the fluxes in the Sun, and the crossovers.
std::string temperature_text(const TemperatureReport& report);

/// All rows and fluxes, described in its comments.
std::string temperature_csv(const TemperatureReport& report);

/// Curves over the day, sunlit in solid lines and shaded ones dashed, with the air, as PNG. Throws SystemError where it cannot
/// be drawn.
std::string temperature_figure(const TemperatureReport& report);

}  // namespace ifov::io
