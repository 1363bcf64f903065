#pragma once

namespace ifov::session {

struct Parts;

/// Sets the footprint of a pixel, and what of its PSF lies beyond.
void assemble_response(Parts& parts);

}  // namespace ifov::session
