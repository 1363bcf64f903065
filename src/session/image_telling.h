#pragma once

namespace ifov::session {

struct Parts;

/// What products say of the image: Parts::info. After all else of it.
void tell_of_image(Parts& parts);

}  // namespace ifov::session
