#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/envi/colour_map.h"

namespace ifov::io {

struct EnviHeader;

/// Makes the header that of an ENVI classification: names of the classes from 0 on (as list_item() has them) and their colours.
void add_classes(std::span<const std::string> names, std::span<const Rgb> colours, EnviHeader& header);

/// Colours of `count` classes of which the first is nothing: black, and then hues a golden angle apart, so that neighbours differ.
std::vector<Rgb> distinct_colours(std::size_t count);

}  // namespace ifov::io
