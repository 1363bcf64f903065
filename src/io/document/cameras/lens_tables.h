#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "io/document/cameras/lens_settings.h"

namespace ifov::sensor {
class Lens;
}

namespace ifov::io {

template <class V>
struct SchemaType;

/// Of a focal plane of so many elements, each `step` of the focal length wide.
struct FocalPlane {
  int width_px = 0, height_px = 0;
  double step = 0.0;
  std::optional<double> focal_length_m;
  bool line = false;  ///< across the track alone

  /// From the middle to the outer corners of its corner elements, or the ends of a line.
  double corner_px() const;
};

/// {"file": …}
SchemaType<DocumentFile> table_file_type(const char* name, const char* doc);

SchemaType<DistortionDocument> distortion_type();
SchemaType<DocumentFile> elements_type();

/// Null of a pinhole. Opens the table: InputError with its place there, SystemError.
std::shared_ptr<const sensor::Lens> lens_of(const LensSettings& settings, const FocalPlane& plane);

/// What a table of elements tells of their sensitive sides, over the pitch.
struct SensitiveSide {
  double side = 1.0;    ///< the mean
  double spread = 0.0;  ///< by how much an element's is another at most, as a share
};
/// None where it tells nothing of them.
std::optional<SensitiveSide> sensitive_side(const LensSettings& settings, const FocalPlane& plane);

/// Image heights in pixels, rising from 0, and the light there. InputError with its place in the table, SystemError.
std::vector<std::array<double, 2>> read_vignetting(const DocumentFile& from, const FocalPlane& plane,
                                                   double pitch_m);

}  // namespace ifov::io
