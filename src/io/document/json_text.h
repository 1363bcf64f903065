#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ifov::io {

/// Members of a JSON object in the order of writing; values are JSON texts.
using JsonMembers = std::vector<std::pair<std::string, std::string>>;

std::string json_string(std::string_view text);  ///< quoted, escaped
std::string json_number(double value);           ///< the shortest that reads back the same
std::string json_list(const std::vector<std::string>& items);
std::string json_object(const JsonMembers& members);

/// The same JSON with two spaces of indentation; lists without objects stay on one line.
std::string json_indented(std::string_view compact);

}  // namespace ifov::io
