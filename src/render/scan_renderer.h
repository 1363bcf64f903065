#pragma once

#include "core/run_control.h"

namespace ifov::sensor {
class PictureStack;
}

namespace ifov::render {

struct RenderControl;
struct RenderJob;
class TileSink;

/// Renders a scanner's image sweep by sweep, each as a picture of its own with random numbers of its own: beside a sweep lies what its own optics
/// would see there, and a thing that several see is in each. Tiles are those of the image (tile_grid). As render_image(), which calls it.
Progress render_scans(const RenderJob& job, const sensor::PictureStack& pictures,
                      const RenderControl& control, TileSink& sink);

}  // namespace ifov::render
