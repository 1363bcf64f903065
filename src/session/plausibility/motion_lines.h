#pragma once

#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::session {

struct Parts;

/// What moves, how far while the image is taken and while one point of it is exposed: lines for people, the first with a heading. Empty
/// where nothing moves.
std::vector<std::string> motion_lines(const Parts& parts);

/// Warns where what the optics or elements of a scanner spread over several lines would show of what moves otherwise than as of what stands
/// still.
void warn_of_motion(const Parts& parts, LogSink& log);

/// Where an accuracy of the image as a whole is asked for and something small that moves, or that a moving camera sees, outshines the scene.
void warn_of_moving_light(const Parts& parts, LogSink& log);

}  // namespace ifov::session
