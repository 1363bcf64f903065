#pragma once

#include <string>
#include <vector>

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// By name; empty: none are named.
std::vector<std::string> shown_channels(const io::Document& document);
/// No picture but a list.
bool is_of_views(const io::Document& document);
/// InputError where every time of a series would be the same picture.
void refuse_what_is_still(const io::Document& document);

}  // namespace ifov::session
