#pragma once

#include <optional>

#include "io/document/document_values.h"
#include "sensor/lens/distortion_terms.h"

namespace ifov::io {

struct ImageSize;

/// Of the lens, by one of both.
struct DistortionDocument {
  sensor::DistortionTerms terms;
  std::optional<DocumentFile> table;  ///< radii
};

/// What directions a camera's focal plane shows: a pinhole's, or by one of these.
struct LensSettings {
  std::optional<DistortionDocument> distortion;
  std::optional<DocumentFile> elements;  ///< where each looks
  int columns = 0, rows = 0;             ///< that the table of elements is of; 0: those of the image

  bool none() const { return !distortion && !elements; }
  /// In an image of other pixels.
  LensSettings of(const ImageSize& size) const;
};

}  // namespace ifov::io
