#pragma once

#include <string>

#include "core/run_control.h"

namespace ifov::session {

struct Parts;

/// Says what light is left out of the picture and was not declared to be: a Sun or Moon below the horizon, no sky, black
/// surroundings that the picture or its surfaces see, reflections beyond max_depth, surfaces without a temperature in
/// thermal channels.
void warn_of_light_left_out(const Parts& parts, LogSink& log);

/// How surroundings that reflect by direction were taken; empty: there are none.
std::string surroundings_statement(const Parts& parts);

}  // namespace ifov::session
