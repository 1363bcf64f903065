#pragma once

#include <span>
#include <string>

#include "core/run_control.h"
#include "render/tolerance/atmosphere_half_width.h"

namespace ifov::session {

struct Parts;

/// One line: how far the channels may be off because of how the air is computed.
std::string atmosphere_error_note(std::span<const render::AtmosphereHalfWidth> air);

/// Says which judged channels the air leaves too little of what is asked for, and what may be asked for
/// instead.
void warn_of_atmosphere_errors(const Parts& parts, LogSink& log);

}  // namespace ifov::session
