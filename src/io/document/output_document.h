#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/document/document_values.h"
#include "io/envi/envi_header.h"
#include "io/quantities/quantity_set.h"

namespace ifov::io {

std::vector<std::string> usual_product_words();  // product_words.h

struct OutputDocument {
  std::string folder;  ///< resolved against the document's folder; by default the document's name with ".out"
  std::string name = "image";  ///< of the products: NAME_radiance.img and so on
  /// Of product_words(), beside what comes with every run.
  std::vector<std::string> formats = usual_product_words();
  EnviInterleave interleave = EnviInterleave::bil;  ///< of the cubes
  std::optional<QuantitySet> products;  ///< the cubes; absent: those that are usual for the camera
  /// None, one (grey) or three (red, green, blue); none: chosen.
  std::vector<DocumentName> quicklook_channels;
  SourcePosition position;
};

}  // namespace ifov::io
