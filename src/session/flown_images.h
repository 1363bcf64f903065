#pragma once

namespace ifov::session {

struct Parts;

/// Images of what outshines the scene are worked out for one place of the camera: InputError where it is exposed from many.
void refuse_flown_images(const Parts& parts);

}  // namespace ifov::session
