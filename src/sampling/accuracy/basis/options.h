#pragma once

#include <cstdint>

#include "sampling/field.h"

namespace ifov::sampling {

/// How the accuracy sampler looks at a picture. None of these changes what the result means, only what it
/// costs and how small an unresolved feature may be before it is missed.
struct AccuracyOptions {
  int lattice = 3;                   ///< lattice cells per pixel side: the detection density is lattice^2
  double initial_bracket_px = 0.04;  ///< width to which an edge crossing is located at first
  double thinnest_px = 1.0 / 80.0;   ///< features at least this wide are followed once they have been hit
  int looks_per_side = 2;   ///< looks_per_side^2 jittered rays in every pixel, drawn anew for every seed
  int probes_per_side = 3;  ///< probes_per_side^2 jittered label rays in each suspect pixel and round
  int max_probe_rounds = 12;
  bool seeds = true;                    ///< one ray through the projected centre of every small object
  bool clutter_switch = true;           ///< stratified samples where tracing edges would cost more
  std::uint32_t tracing_budget = 1500;  ///< label rays after which a pixel counts as clutter
  bool footprint_by_model = true;  ///< weight the traced picture by the footprint; false: draw rays from it
  std::uint32_t max_samples_per_pixel = 1u << 16;
};

/// Defects planted by tests to show that they would be noticed. Never set elsewhere.
struct AccuracyFaults {
  Label label_mask = ~Label{0};  ///< bits of a label that the sampler sees (without the Sun's state, say)
  bool zero_variance_single_samples = false;  ///< a stratum of one sample claims to be exact
  bool undithered_brackets = false;  ///< brackets by plain bisection, whose errors agree on aligned scenes
  bool no_random_look = false;       ///< no rays beside the lattice in pixels where nothing is suspect
  bool other_labels_spread = false;  ///< few values of a label vary as those of other labels do
  bool one_sequence = false;  ///< the replicates of a round share their paths' sequence, and so their errors
};

}  // namespace ifov::sampling
