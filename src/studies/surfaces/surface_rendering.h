#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "studies/common/study_options.h"

namespace ifov::io {
struct Document;
}

namespace ifov::studies {

/// An image of one channel, row by row.
struct SurfaceImage {
  int width = 0, height = 0;
  std::vector<float> radiance, half_width;  ///< W m-2 sr-1 um-1
  std::vector<std::uint32_t> samples;
  std::vector<std::uint8_t> converged;
  std::size_t index(int x_px, int y_px) const { return static_cast<std::size_t>(y_px * width + x_px); }
};

/// Renders a document of one channel as any other, files and threads as the options say.
SurfaceImage render_surface(const io::Document& document, const StudyOptions& options);

}  // namespace ifov::studies
