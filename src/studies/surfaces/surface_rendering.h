#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/vec3.h"
#include "studies/common/study_options.h"

namespace ifov::io {
struct CameraDocument;
struct Document;
}  // namespace ifov::io

namespace ifov::studies {

/// An image of one channel, row by row.
struct SurfaceImage {
  int width = 0, height = 0;
  std::vector<float> radiance, half_width;  ///< W m-2 sr-1 um-1
  std::vector<std::uint32_t> samples;
  std::vector<std::uint8_t> converged;
  std::size_t index(int x_px, int y_px) const { return static_cast<std::size_t>(y_px * width + x_px); }
};

/// A frame camera with square images, which looks from one place at another; `half`: tangent of the angle between its axis and the
/// middle of a side.
io::CameraDocument square_camera(int pixels, double half, math::Point3 position_m, math::Point3 target_m);

/// Renders a document of one channel as any other, files and threads as the options say.
SurfaceImage render_surface(const io::Document& document, const StudyOptions& options);

}  // namespace ifov::studies
