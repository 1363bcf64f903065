#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "atmosphere/imported_path.h"
#include "radiometry/spectrum.h"

namespace ifov::atmosphere {

/// What another code computed for one atmosphere, one Sun and one line of sight from the ground to the
/// sensor.
struct ImportedRuns {
  /// One to three, over level Lambertian grounds that differ in albedo alone.
  std::vector<ImportedPath> runs;
  std::vector<double> albedo;  ///< of these grounds
  /// Runs that tell about the light above and at the ground alone, over black ground: the direct beam of the
  /// Sun, irradiances, the spherical albedo. They fill in what `runs` do not say, at their wavelengths.
  std::vector<ImportedPath> lights;
};

/// The Sun of the scene. Its irradiance stands in where the runs do not state theirs.
struct SunAbove {
  double cos_zenith = 1.0;          ///< at the ground, above 0
  radiometry::Spectrum irradiance;  ///< across the beam above the air, at the date's distance, W m-2 um-1
};

/// Whether the path says anything about the way to a sensor (else it may be one of ImportedRuns::lights).
bool sees_ground(const ImportedPath& path);

/// What the runs say, wherever they say it: one quantity after the other, at the wavelengths of the darkest
/// run.
class RunQuantities {
 public:
  using Column = std::vector<double>;

  /// `given` must outlive this. InputError for no runs, and for runs that look up or have the Sun more than a
  /// degree from where `sun` has it.
  RunQuantities(const ImportedRuns& given, const std::optional<SunAbove>& sun);

  const ImportedPath& dark() const { return given_.runs[dark_]; }
  const ImportedPath& bright() const { return given_.runs[bright_]; }
  double dark_albedo() const { return given_.albedo[dark_]; }
  double bright_albedo() const { return given_.albedo[bright_]; }

  /// Of the runs, the darkest first, else of the lights; empty where none has it.
  Column any(PathQuantity quantity) const;
  /// Of the darkest run alone, and of the lights alone; empty where it is absent.
  Column of_dark(PathQuantity quantity) const;
  Column of_lights(PathQuantity quantity) const;

  /// Throws the InputError about a quantity that no run has.
  [[noreturn]] void missing(std::string_view what, PathQuantity quantity, std::string_view advice) const;

 private:
  const ImportedRuns& given_;
  std::size_t dark_ = 0, bright_ = 0;
};

}  // namespace ifov::atmosphere
