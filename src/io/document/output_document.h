#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/document/document_values.h"
#include "io/quantities/quantity_set.h"

namespace ifov::io {

std::vector<std::string> usual_product_words();  // product_words.h

struct OutputDocument {
  std::string folder;  ///< resolved against the document's folder; by default the document's name with ".out"
  std::string name = "image";                                ///< of the products: NAME_radiance.img and so on
  std::vector<std::string> formats = usual_product_words();  ///< beside what every run has
  std::string interleave = "bil";                            ///< of the cubes, as headers say it
  std::optional<QuantitySet> products;           ///< the cubes; absent: those that are usual for the camera
  std::vector<DocumentName> quicklook_channels;  ///< none (chosen), or one or three (red, green, blue)
  SourcePosition position;
};

}  // namespace ifov::io
