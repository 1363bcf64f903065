#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ifov {

/// What a terminal may be sent: lines stay lines; control characters, characters that turn the direction of writing and
/// bytes that are not UTF-8 are written out, such as \x1b, \u202e and \xff.
std::string printable(std::string_view text);

/// The same, cut to about `most` bytes, with an ellipsis where it was longer.
std::string printable(std::string_view text, std::size_t most);

/// For a message about a user's files, which may quote them: some screens full at most.
std::string printable_message(std::string_view text);

}  // namespace ifov
