#pragma once

#include "io/products/acquisition.h"
#include "session/parts.h"

namespace ifov::session {

/// What a run's products say of when, where and in which light their image was taken.
io::Acquisition assemble_acquisition(const Session::Parts& parts);

}  // namespace ifov::session
