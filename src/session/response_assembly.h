#pragma once

namespace ifov::session {

struct Parts;

/// Sets camera, channels, what paths carry of them, where elements look, and polarimetry.
void assemble_sensor(Parts& parts);

/// Sets the footprint of a pixel, and what of its PSF lies beyond; again once the light is known, where something outshines the scene.
void assemble_response(Parts& parts);
void keep_more_of_psf(Parts& parts);

/// What products say of the image, its footprint included: Parts::info. After all else of it.
void tell_of_image(Parts& parts);

}  // namespace ifov::session
