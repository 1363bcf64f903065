#pragma once

#include "ifov/simulation.h"
#include "render/tile_sink.h"
#include "session/runs/run.h"

namespace ifov::session {

ImageDescription describe_image(const render::ImageInfo& image);

/// Renders the document's image and hands its tiles to `sink`; no folder and no files in the result.
RunResult render_tiles(const Session& session, const TileOptions& options, TileSink& sink);

}  // namespace ifov::session
