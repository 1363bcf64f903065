#pragma once

#include <cstdint>
#include <string>

namespace ifov::io {

/// Four digits; a dash for what is not finite.
std::string figure(double value);
/// All digits, in groups of three.
std::string count(std::uint64_t value);
/// "12.3 M"
std::string short_count(double value);
/// "12.3 s", "17 min", "2.5 h"
std::string duration(double seconds);
/// "2nd", "3rd", "4th"
std::string ordinal(int number);

}  // namespace ifov::io
