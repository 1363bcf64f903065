#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "thermal/wild_thermal.h"

namespace ifov::benchmarks {

/// How hard a point's own full solution is worked at.
struct ThermalEffort {
  int sky_pairs = 1024, sun_rays = 8;  ///< to the sky, and to each of the Sun's places
  int rays_beside = 24, depth = 1;  ///< to what is about it, four times; and how many surfaces behind these
  int draws = 400;                  ///< of images' estimates
};

/// A point whose temperature images draw, beside its own full solution; kelvins.
struct JudgedPoint {
  double x = 0.0, y = 0.0, z = 0.0;
  std::string material;
  double up = 0.0;  ///< cosine of its normal from straight up
  bool from_above = false;
  double image_k = 0.0, image_error_k = 0.0;  ///< mean of the draws, and its standard error
  double told_error_k = 0.0;                  ///< that, by the variance that the draws tell of themselves
  double full_k = 0.0, full_error_k = 0.0;    ///< with what is about it
  double class_off_k = 0.0;                   ///< of the class alone, without what is about it
  double beside_k = 0.0;                      ///< what is about it does in the full solution
  double linear_k = 0.0;                      ///< the same to first order
  double half_width_k = 0.0;
  double free_sky = 0.0, sun_share = 0.0;
  double off_k() const { return image_k - full_k; }
  double noise_k() const;
};
std::vector<JudgedPoint> judge_points(const std::string& text, const std::string& name, double reach_m,
                                      double top_m, int points, std::uint64_t seed,
                                      const ThermalEffort& effort, int threads);

}  // namespace ifov::benchmarks
