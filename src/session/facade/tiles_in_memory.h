#pragma once

#include "ifov/simulation.h"
#include "session/runs/run.h"

namespace ifov::io {
struct Document;
struct RunPlan;
}  // namespace ifov::io

namespace ifov::session {

/// What a plan's image is.
ImageDescription describe_image(const io::RunPlan& plan);

/// Renders the document's image, or samples it as another one says (`sampling`, may be null), and hands its tiles to `sink`; no
/// folder and no files in the result. Throws InputError where what was loaded does not do for that sampling.
RunResult render_tiles(const Session& session, const TileOptions& options, const io::Document* sampling,
                       TileSink& sink);

}  // namespace ifov::session
