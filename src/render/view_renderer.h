#pragma once

#include "core/run_control.h"

namespace ifov::sensor {
class ViewListCamera;
}

namespace ifov::render {

struct RenderControl;
struct RenderJob;
class TileSink;

/// Renders a job's single views one by one, each as an image of its own with random numbers of its own; view k is tile k of
/// the list's line. Threads share the views out: one view takes one thread. As render_image(), which calls it.
Progress render_views(const RenderJob& job, const sensor::ViewListCamera& views, const RenderControl& control,
                      TileSink& sink);

}  // namespace ifov::render
