#pragma once

#include <chrono>
#include <string>

namespace ifov::cli {

/// "90s", "10min", "1.5 h" or "2d". Throws InputError on anything else; `option` is named in it.
std::chrono::duration<double> read_duration(const std::string& text, const std::string& option);

}  // namespace ifov::cli
