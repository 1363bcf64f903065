#pragma once

namespace ifov::session {

struct Parts;

/// Sets the footprint of a pixel, and what of its PSF lies beyond.
void assemble_response(Parts& parts);

/// What products say of the image, its footprint included: Parts::info. After all else of it.
void tell_of_image(Parts& parts);

}  // namespace ifov::session
