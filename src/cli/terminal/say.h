#pragma once

#include <string>

namespace ifov::cli {

/// The two ways to the terminal. Names and lines of users' files come with control characters written out.
void say(const std::string& text);          ///< a result, to standard output as it is
void complain(const std::string& message);  ///< a line to standard error, cut where it is very long

}  // namespace ifov::cli
