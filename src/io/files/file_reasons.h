#pragma once

#include <string>

namespace ifov::io {

/// Why the system would not do with a file what it was asked to, for people: "no such file".
std::string file_reason(int error);

}  // namespace ifov::io
