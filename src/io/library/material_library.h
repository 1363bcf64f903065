#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "radiometry/spectrum.h"

namespace ifov::io {

/// Wavelengths at which a curve was not measured, and where its figures come from there.
struct LentRange {
  double first_um = 0.0, last_um = 0.0;
  std::string how;
};

/// One sample of a material. Reflectance is directional-hemispherical; both spectra reach over the whole
/// grid.
struct LibraryCurve {
  std::string name;
  std::string sample;                    ///< what was measured or modelled
  std::vector<std::string> origins;      ///< publications and licences
  bool modelled = false;                 ///< else measured
  double first_um = 0.0, last_um = 0.0;  ///< of the measurement or the model
  std::vector<LentRange> lent;
  std::vector<std::string> notes;
  double largest_difference = 0.0, rms_difference = 0.0;  ///< of the figures from the sample's own points
  radiometry::Spectrum reflectance;
  std::optional<radiometry::Spectrum> transmittance;  ///< of a leaf, modelled; none: opaque, or not known

  /// 1 - reflectance - transmittance (Kirchhoff).
  radiometry::Spectrum emissivity() const;
};

struct LibraryMaterial {
  std::string name;                ///< plain words: "grass, lawn"
  std::vector<std::string> words;  ///< more words that a search finds it by; the first is its group
  std::string about;
  std::vector<std::string> instead_of;  ///< names of earlier libraries that this is nearest to
  std::vector<LibraryCurve> curves;     ///< at least one

  const std::string& group() const { return words.front(); }
  /// Position of the curve with this name; an InputError lists the curves where there is none.
  std::size_t curve_named(std::string_view curve) const;
  /// The same from a number that counts from 1.
  std::size_t curve_numbered(int number) const;
};

/// Materials by name. Immutable.
class MaterialLibrary {
 public:
  /// From tables in the format of data/materials (docs/formats/data.md). Throws InputError, with table and
  /// line, where one is not well formed.
  explicit MaterialLibrary(std::span<const std::pair<std::string, std::string_view>> tables);

  std::span<const LibraryMaterial> materials() const { return materials_; }
  /// By its full name, letters compared without case; an InputError names near misses, and of a name of an
  /// earlier library what is nearest to it now.
  const LibraryMaterial& find(std::string_view name) const;
  bool has(std::string_view name) const;
  /// Materials whose name or words hold every word of the text (as the start of a word), in the library's
  /// order.
  std::vector<const LibraryMaterial*> search(std::string_view text) const;

 private:
  std::vector<LibraryMaterial> materials_;
};

/// The library that is compiled in: 0.35 to 14 um.
const MaterialLibrary& material_library();

}  // namespace ifov::io
