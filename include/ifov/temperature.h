#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ifov/document.h"

namespace ifov {

/// Which surfaces are asked about, and how they stand.
struct TemperatureQuestion {
  std::vector<std::string> materials =
      {};                    ///< by name; empty: all that say what their temperature follows from
  double slope_rad = 0.0;    ///< 0: level
  double azimuth_rad = 0.0;  ///< that a slope faces, clockwise from north
  double height_m = 0.0;     ///< above ground, for the wind
};

/// A point of a document's scene: the first surface that is met from a place in a direction.
struct PointQuestion {
  /// Where from, in metres of the scene; a height of infinity: above everything.
  double x_m = 0.0, y_m = 0.0, z_m = std::numeric_limits<double>::infinity();
  double along_x = 0.0, along_y = 0.0, along_z = -1.0;  ///< of any length but 0; down
  /// What is met must be of the document's object of this name, and others are passed by; empty: all are met.
  std::string object = {};
  bool above_object = false;  ///< from above the middle of the object, in place of x and y
};

/// How warm materials were over the 24 hours before the document's time, in the Sun and out of it.
class IFOV_API TemperatureReport {
 public:
  struct Material {
    std::string name;
    std::vector<double> sunlit_k, shaded_k;  ///< at each of time_s
    double unaccounted =
        0.0;  ///< heat that is lost in the sunlit solution (a point's own), over what came in
    std::vector<double> here_k;  ///< of a point: as the Sun and the sky reached it; else empty
  };
  /// When one sunlit surface becomes warmer than another.
  struct Crossover {
    double time_s = 0.0;
    std::size_t warmer = 0, cooler = 0;  ///< from then on, by their position in materials
  };
  std::vector<std::string> notes;  ///< what was solved, and what stood in for what the weather does not tell
  std::vector<double> time_s;      ///< seconds of UTC since 1970, a step apart
  std::vector<double> air_k;
  std::vector<Material> materials;
  std::vector<Crossover> crossovers;  ///< in order of time

  // What `ifov temperature` prints, writes and draws.

  /// Tables for a terminal, hour by hour.
  std::string table() const;
  /// All steps and fluxes, described in its comments.
  std::string csv() const;
  /// PNG. Throws SystemError where it cannot be drawn.
  std::string figure() const;

 private:
  struct Inside;
  std::shared_ptr<const Inside> inside_;
  friend struct FacadeAccess;
};

/// Of a document with a time, weather and a place: no other file is read than those of its weather and of its spectra. Throws
/// InputError where one of these is missing; where the weather does not tell what is needed, does not reach back over the
/// spin-up, or has another clock than UTC; where a material that is asked for says nothing that its temperature follows
/// from.
IFOV_API TemperatureReport survey_temperatures(const Document& document,
                                               const TemperatureQuestion& question = {});

/// Of a point of its scene, which is loaded: solved in full by itself, under what rays say of the Sun and the sky there and then; one
/// material, beside what it would be always in the Sun and never. Throws InputError as Simulation::load, and where nothing is met
/// or what is met has no solved temperature.
IFOV_API TemperatureReport point_temperature(const Document& document, const PointQuestion& question);

}  // namespace ifov
