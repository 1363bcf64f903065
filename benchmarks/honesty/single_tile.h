#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::benchmarks {

/// Loads a document from text; files that it names lie in the folder of `file`, which need not exist itself.
session::Session load_text(const std::string& text, const std::filesystem::path& file);

/// Renders an image that is one tile, on one thread, with this seed. Reproducible: the answer depends on the session
/// and the seed alone. Throws std::runtime_error where the image has several tiles.
sampling::TileResult render_tile(const session::Session& session, std::uint64_t seed);

/// The same of any job.
sampling::TileResult render_tile(const render::RenderJob& job);

}  // namespace ifov::benchmarks
