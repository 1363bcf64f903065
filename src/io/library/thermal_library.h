#pragma once

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "thermal/faces/convection.h"
#include "thermal/faces/leaf.h"
#include "thermal/solid.h"

namespace ifov::io {

class TextFile;

/// A solid by its name: a layer of no thickness yet.
struct LibrarySolid {
  std::string name, about, source;
  thermal::SolidLayer values;
  double melts_k = std::numeric_limits<double>::infinity();
};

/// What a surface of the spectral library stands on.
struct LibrarySurface {
  enum class Back { insulated, ground, room, other_side };
  std::vector<thermal::SolidLayer> layers;
  Back back = Back::insulated;
  thermal::Roughness roughness = thermal::Roughness::rough;
  thermal::Leaf leaf;  ///< of a width, where it is one
  double wet_share = 0.0, resistance_s_m = 0.0;
  double melts_k = std::numeric_limits<double>::infinity();  ///< of the first layer
};

/// Thermal materials by name. Immutable.
class ThermalLibrary {
 public:
  /// From a table in the format of data/thermal (docs/formats/data.md). Throws InputError, with table and line, where it
  /// is not well formed.
  explicit ThermalLibrary(const TextFile& file);

  const std::vector<LibrarySolid>& solids() const { return solids_; }
  /// By its name, letters compared without case; an InputError names near misses.
  const LibrarySolid& solid(std::string_view name) const;
  /// By the name of a material of the spectral library; null where there is none.
  const LibrarySurface* surface(std::string_view spectral_name) const;

 private:
  std::vector<LibrarySolid> solids_;
  std::map<std::string, LibrarySurface, std::less<>> surfaces_;
};

/// The library that is compiled in.
const ThermalLibrary& thermal_library();

}  // namespace ifov::io
