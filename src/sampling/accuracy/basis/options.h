#pragma once

#include <cstdint>

namespace ifov::sampling {

/// How the accuracy sampler looks at a picture. None of these changes what the result means, only what it
/// costs and how small an unresolved feature may be before it is missed.
struct AccuracyOptions {
  int lattice = 3;                   ///< lattice cells per pixel side: the detection density is lattice^2
  double initial_bracket_px = 0.04;  ///< width to which an edge crossing is located at first
  double thinnest_px = 1.0 / 80.0;   ///< features at least this wide are followed once they have been hit
  int random_rays_per_side =
      2;  ///< random_rays_per_side^2 jittered rays in every pixel, drawn anew for every seed
  int probes_per_side = 3;  ///< probes_per_side^2 jittered label rays in each suspect pixel and round
  int max_probe_rounds = 12;
  bool pilot_rays = true;               ///< one ray through the projected centre of every small object
  bool clutter_switch = true;           ///< stratified samples where tracing edges would cost more
  std::uint32_t tracing_budget = 1500;  ///< label rays after which a pixel counts as clutter
  bool footprint_by_model = true;  ///< weight the traced picture by the footprint; false: draw rays from it
  std::uint32_t max_samples_per_pixel = 1u << 16;
};

}  // namespace ifov::sampling
