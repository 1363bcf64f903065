#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ifov::io {

/// How warm materials look over the times of a series, by its products.
struct SeriesReport {
  std::string document;            ///< its name
  std::string channel;             ///< that brightness temperatures are of: "thermal (11 um)"
  std::vector<std::string> notes;  ///< which pixels count, and the like: a line each
  std::vector<double> time_s;      ///< of each picture: seconds of UTC since 1970

  /// Over the pixels that show one material. Not a number where there are none.
  struct Means {
    std::vector<double> mean_k, deviation_k;  ///< by time: mean, and standard deviation from pixel to pixel
  };
  struct Material {
    std::string name;
    std::vector<std::size_t> pixels;  ///< by time
    Means brightness,
        surface;  ///< `surface`: of the temperatures themselves; empty where no product tells them
  };
  std::vector<Material> materials;  ///< those that have pixels at some time
  bool tells_surface = false;       ///< curves and crossovers are of temperatures themselves

  /// When one material becomes warmer than another.
  struct Crossover {
    double time_s = 0.0;
    std::size_t warmer = 0, cooler = 0;  ///< from then on; materials by their position
    std::string when;  ///< "dawn", "dusk", "night"; empty where it is not known where the scene stands
  };
  std::vector<Crossover> crossovers;  ///< in order of time

  /// When the Sun is below the horizon: from the first to the second, seconds since 1970.
  struct Night {
    double begin_s = 0.0, end_s = 0.0;
  };
  std::vector<Night> nights;

  const Means& told(const Material& material) const {
    return tells_surface ? material.surface : material.brightness;
  }
};

/// Materials whose curves come no further apart than this on either side have not crossed.
inline constexpr double kApart_k = 0.1;

/// Finds the crossovers of all pairs, linear between times; `when` is left empty. A pair crosses where one is warmer by kApart_k or
/// more and later the other is.
std::vector<SeriesReport::Crossover> crossovers_of(const SeriesReport& report);

/// One line a time and material, described in its comments, with the crossovers.
std::string series_csv(const SeriesReport& report);

/// Curves over the times with the crossovers, and these in words, as PNG. Throws SystemError where it cannot be drawn.
std::string series_figure(const SeriesReport& report);

}  // namespace ifov::io
