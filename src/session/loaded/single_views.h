#pragma once

namespace ifov::session {

struct Parts;

/// Of a document with single views in place of a camera: InputError, at their place in the document, where its air is not worked out along
/// their rays. To be called once the camera is there and before the atmosphere.
void check_single_views(const Parts& parts);

/// What falls on a level surface, by channel, into the image's info, where nothing lies between views and scene that reflectance
/// factors would have to do without.
void tell_irradiance(Parts& parts);

}  // namespace ifov::session
