#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "studies/common/study_options.h"
#include "thermal/surface_balance.h"

/// What the sections of the study of temperatures measure, for them and for the tests.
namespace ifov::studies {

/// Half-spaces of concrete whose answers stand in closed form: Carslaw and Jaeger (1959), 2.6 to 2.9.
enum class SlabCase { periodic_flux, step_flux, air_step, periodic_flux_in_air };
inline constexpr int kSlabCases = 4;
/// Their names in the reference data.
const char* name_of(SlabCase of);
double closed_form_k(SlabCase of, double time_s, double depth_m);
/// Largest difference of the solution from that after 10 minutes, 1 and 6 hours (waves: over a day) at the surface and three depths.
/// `conductivity_factor`: of what is solved; not 1: a planted fault.
double slab_error_k(SlabCase of, double step_s, double conductivity_factor = 1.0);
/// Largest difference of rows of the reference file from the closed forms, and their number.
struct FileDifference {
  double worst_k = 0.0;
  std::size_t rows = 0;
};
FileDifference closed_forms_off_file(const std::filesystem::path& file);
/// A road of two layers and a wall of three under a daily wave: largest difference from its matrices (the same, 3.7).
double layered_error_k(double step_s, double capacity_factor = 1.0);
/// Lowest order of three halvings.
double order_in_cells();
double order_in_steps();

/// A plate without mass, of an emissivity of 0.9, under a black sky.
double steady_plate_k(double absorbed_w_m2, double sky_k, double convection_w_m2_k, double air_k);
/// Heat that is lost in four days of a road, dry and wet, over what came in: the larger.
double heat_unaccounted();
/// THERM's slab against the same numbers in 50 slices by explicit steps; `exposed_area` of what is solved, by hand it is 0.75.
double therm_error_k(double exposed_area = 0.75);

/// What may be wrong about the outdoors that surfaces are solved under.
enum class Fault {
  none,
  no_diffuse_light,
  wind_of_10_m,
  local_clock,  ///< the Sun stands where it did two hours before
  sky_as_air,   ///< as warm as the air
  other_yesterday
};
thermal::OutdoorsSeries planted(const thermal::OutdoorsSeries& series, Fault fault);

/// Fifteen places north of a pole by whose shadow they were passed, at 15 h: the estimates' mean against one dimension solved in full
/// with the shadow worked out from the pole's outline.
struct PlacesOffK {
  double worst_k = 0.0, range_k = 0.0;  ///< from the coldest to the warmest
};
PlacesOffK pole_shadow(const StudyOptions& options, Fault fault = Fault::none);
/// Three places about a car that left so many minutes before 15 h: likewise, minute by minute; and how far off they are where nothing ever
/// stood.
struct CarTrace {
  double worst_k = 0.0, without_k = 0.0;
};
CarTrace car_trace(int left_min, const StudyOptions& options);

/// Flat roofs of 4 to 50 m and the street below against one dimension in a wind raised by the logarithmic law by hand. `blind`: of the
/// street's wind everywhere: a planted fault.
struct RoofWind {
  double worst_k = 0.0;
  std::vector<double> height_m, roof_k, expected_k;
};
RoofWind roof_wind(bool suburb, const StudyOptions& options, bool blind = false);

/// Drift of a closed room as warm as the air, and of what is in it.
double closed_room_drift_k(const StudyOptions& options);

/// Random points of the suburb at these hours ("14:00"), each solved in full by itself, of the same exposure.
struct SuburbPoints {
  std::size_t points = 0;
  double rms_k = 0.0, worst_k = 0.0, bias_k = 0.0;
  double estimate_bias_k = 0.0,
         estimate_error_k = 0.0;  ///< of what rays by chance tell, and its standard error
  double covered = 0.0;           ///< by the half-width that is stated of their material
  /// Of every tenth point, with the surfaces about it as they are, each solved in full: root mean square and mean of what images are off by,
  /// its standard error, and the share that half-widths hold; and the root mean square were these surfaces ground.
  double beside_rms_k = 0.0, beside_bias_k = 0.0, beside_error_k = 0.0, beside_covered = 0.0,
         without_beside_rms_k = 0.0;
  double covered_by_image = 0.0,
         covered_by_half = 0.0;      ///< by that of the image; by half of their material's
  std::vector<double> half_width_k;  ///< stated of the image, by hour
  std::vector<double> full_k, off_k;
};
/// `wind_direction`: whether the weather tells it.
SuburbPoints suburb_points(std::size_t points_an_hour, std::span<const char* const> hours,
                           bool wind_direction, const StudyOptions& options);
inline constexpr std::array<const char*, 4> kSuburbHours{"05:00", "09:00", "14:00", "20:00"};

/// Seconds for a million estimates of a point's temperature on two threads, and whether 1, 2 and 7 threads tell the same.
struct QueryCost {
  double seconds = 0.0;
  bool same = false;
};
QueryCost query_cost(std::size_t queries, const StudyOptions& options);

}  // namespace ifov::studies
