#pragma once

#include "ifov/simulation.h"
#include "render/tile_sink.h"
#include "session/runs/run.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

ImageDescription describe_image(const render::ImageInfo& image);

/// Renders the document's image, or samples it as another one says (`sampling`, may be null), and hands its tiles to `sink`; no
/// folder and no files in the result. Throws InputError where what was loaded does not do for that sampling.
RunResult render_tiles(const Session& session, const TileOptions& options, const io::Document* sampling,
                       TileSink& sink);

}  // namespace ifov::session
