#pragma once

#include <span>
#include <string>

#include "core/run_control.h"
#include "render/tolerance/atmosphere_half_width.h"

namespace ifov::radiometry {
struct Channel;
}

namespace ifov::session {

struct Parts;

/// One line: how far the channels may be off because of how the air is computed.
std::string atmosphere_error_note(std::span<const render::AtmosphereHalfWidth> air);

/// One line: how far they may be off because the model is not the air, the channels where it is most, and whether intervals
/// hold it. Of `cloudy` air: that it is not known, and what it were without the clouds.
std::string model_error_note(std::span<const render::AtmosphereHalfWidth> air,
                             std::span<const radiometry::Channel> channels, bool cloudy);

/// Says which judged channels the air leaves too little of what is asked for, and what may be asked for
/// instead, and where the model's own error is larger than what is asked for.
void warn_of_atmosphere_errors(const Parts& parts, LogSink& log);

}  // namespace ifov::session
