#pragma once

#include <cstddef>
#include <vector>

#include "studies/common/study_options.h"
#include "studies/sensor/sensor_rendering.h"

/// What the sections of the study measure, for them and for the tests.
namespace ifov::studies {

/// Largest distance that a point is off after transforms between geodetic, ECEF, ENU, body and TEME and back, up to 500 km.
double frames_there_and_back_m();

/// Largest distance between what pixels of 1 m are told to see from 700 km up, straight down and aslant, on level and on sloping
/// ground, and where the rays of that perspective meet it. `focal_length_error`: of what is expected, relative; not 0: a planted fault.
double rays_from_orbit_m(const StudyOptions& options, double focal_length_error = 0.0);

/// Ground of facets, up to 20 m high.
double facet_height_m(double x_m, double y_m);
/// Places that are told of the pixels of a rolling scanner, on level ground or on these facets: how far their images, by rays from
/// there to where it flies, are from the middles of the pixels, and how far they are from the ground.
struct PlacesOff {
  double image_px = 0.0, ground_m = 0.0;  ///< largest
};
PlacesOff places_off(bool rough, const StudyOptions& options, double late_s = 0.0);

/// A plane of 300 K with a noise of so many kelvins, drawn by ifov::detect: brightness temperatures at 10 um.
struct NoisyPlane {
  double mean_k = 0.0, spread_k = 0.0;
  std::size_t pixels = 0;
};
NoisyPlane noisy_plane(int pixels_across, double nedt_k, const StudyOptions& options);

/// A yard with a mirror, a warm box and a pane under Sun, sky and air, whose radiance is told in parts.
struct PartsSum {
  double worst = 0.0;          ///< largest difference of the sum from the radiance, relative
  std::vector<double> shares;  ///< of the image's radiance: emitted, Sun, sky, scene, path
};
/// `planted_factor`: on the Sun's part; not 1: a planted fault.
PartsSum parts_sum(const StudyOptions& options, double planted_factor = 1.0);

/// Points in the image of a wavefront of one polynomial, by Noll's numbers, against the pupil's integral: the largest difference over the
/// peak. `sign` of the wavefront; -1: a planted fault.
double pupil_points_off(int noll, double sign);

/// The most memory that this process has held when it has rendered black ground with truth.
double memory_of_cube_gib(int pixels_across, int channels, const StudyOptions& options);

/// Noise on a rendered cube of black ground: wall time, files and all, and whether another number of threads makes the same bytes.
struct DetectTime {
  double seconds = 0.0;
  bool same_bytes = false;
};
DetectTime detect_cube(int pixels_across, int channels, int seeds, const StudyOptions& options);

}  // namespace ifov::studies
