#pragma once

#include <optional>

#include "io/document/spectrum_document.h"

namespace ifov::io {

/// Carriers that wander sideways before an element takes them: of light from behind, or from the front.
struct DiffusionDocument {
  std::optional<double> field_free_m;          ///< from behind: the layer without a field
  std::optional<double> depletion_m;           ///< from the front: the depth with one
  std::optional<double> length_m;              ///< diffusion length
  std::optional<SpectrumDocument> absorption;  ///< coefficient, 1/um
};

/// What elements pass to their neighbours, as shares of what falls on them: to each.
struct CrosstalkDocument {
  double share = 0.0;                   ///< beside, and above and below where that is not told
  std::optional<double> above, corner;  ///< as `share`; 0
};

}  // namespace ifov::io
