#pragma once

#include <string>
#include <vector>

#include "io/figures/canvas.h"

namespace ifov::io {

/// Words in lines of at most `width`; a longer word has a line of its own.
std::vector<std::string> wrapped(const Canvas& canvas, const std::string& words, double size, double width,
                                 bool bold = false);

/// Cut, with three dots, where they are wider than `width`.
std::string fitted(const Canvas& canvas, std::string words, double size, double width);

}  // namespace ifov::io
