#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/document/document_values.h"

namespace ifov::io {

enum class ProductFormat { envi, geotiff, png, html };

struct OutputDocument {
  std::string folder;  ///< resolved against the document's folder; by default the document's name with ".out"
  std::vector<ProductFormat> formats{ProductFormat::envi, ProductFormat::geotiff, ProductFormat::png,
                                     ProductFormat::html};
  std::vector<DocumentName>
      quicklook_channels;  ///< none, one (grey) or three (red, green, blue); none: chosen
  SourcePosition position;
};

}  // namespace ifov::io
