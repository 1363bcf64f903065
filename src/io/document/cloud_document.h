#pragma once

#include <optional>
#include <string>

#include "core/error.h"

namespace ifov::io {

/// A level cloud, the same everywhere.
struct CloudDocument {
  std::string kind = "water";                 ///< or "ice"
  double base_km = 0.0, top_km = 0.0;         ///< above mean sea level
  std::optional<double> optical_depth;        ///< vertical, at 0.55 um; or ...
  std::optional<double> water_path_g_m2;      ///< ... of water or ice
  std::optional<double> effective_radius_um;  ///< absent: 10 of water, 30 of ice
  double effective_variance = 0.1;
  SourcePosition position;
  bool is_ice() const { return kind == "ice"; }
  double radius_um() const { return effective_radius_um.value_or(is_ice() ? 30.0 : 10.0); }
};

}  // namespace ifov::io
