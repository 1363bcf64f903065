#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ifov::studies {

/// Components that the panels hold of each transform.
inline constexpr int kScatterPlotAxes = 4;

/// The pixels of one image in the space of a transform.
struct ScatterPlotImage {
  std::string name;
  std::vector<float> principal, noise_fraction;  ///< kScatterPlotAxes a pixel
  std::vector<std::uint8_t> dominant;            ///< index of the material that fills most of each pixel
};

/// An n-dimensional scatter plot of several images side by side, interactive: one part of a page, with its data and
/// script. All panels share axes, scale and viewpoint; dragging turns them, the components that make up the axes and
/// the colouring (density or material) can be chosen. The last panel can show any of the images from the fourth on.
std::string scatter_plots(const std::vector<ScatterPlotImage>& images,
                          const std::vector<std::string>& materials);

}  // namespace ifov::studies
