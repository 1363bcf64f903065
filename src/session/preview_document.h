#pragma once

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// The document of a preview: the channels of its picture alone, at most `longest_px` pixels a side over the same
/// field of view, perfect optics, and no accuracy asked for.
io::Document for_preview(io::Document document, int longest_px);

}  // namespace ifov::session
