#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session/session.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// The document for a first look: the channels of its picture alone, at most `longest_px` pixels a side over the same
/// field of view, perfect optics, and no accuracy asked for.
io::Document for_preview(io::Document document, int longest_px);

struct PreviewOptions {
  /// For paths; every pixel gets one, if that takes longer, unless it takes ten times as long.
  double seconds = 3.0;
  int threads = 0;  ///< 0: all cores
  const CancelToken* cancel = nullptr;
};

/// A picture without a promise.
struct Preview {
  int width_px = 0, height_px = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xRRGGBB, rows from the top
  std::string png;                    ///< the same, with title and range
  std::string statement;              ///< how many paths stand behind it
};

/// One path after another at each pixel, coarse first. Throws Cancelled.
Preview make_preview(const Session& session, const PreviewOptions& options);

}  // namespace ifov::session
