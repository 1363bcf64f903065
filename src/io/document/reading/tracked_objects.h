#pragma once

namespace ifov::io {

struct Document;
struct PlatformFlight;

/// Finds the paths of what a flight's gimbals track. Throws InputError with the place in the document where there is no such thing, or no
/// place for a point; and where other mounts are reported than there are.
void find_tracked(const Document& document, PlatformFlight& flight);

}  // namespace ifov::io
