#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/document/document_values.h"
#include "io/document/spectrum_document.h"

namespace ifov::io {

/// Materials as a mesh file tells them: colours and pictures.
struct FileMaterials {
  struct Colour {
    std::array<int, 3> srgb{};  ///< red, green and blue, 0 to 255
    DocumentName material;
  };
  std::vector<Colour>
      colours;  ///< materials that colours stand for, the nearest of them; empty: reflectance is made of colours
  std::vector<std::pair<std::string, DocumentName>>
      slots;                               ///< materials of the document instead of the file's, by slot
  std::optional<SpectrumDocument> beyond;  ///< reflectance outside of 0.38 to 0.78 um
};

}  // namespace ifov::io
