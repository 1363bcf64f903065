#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ifov {

/// How many insertions, deletions, replacements and swaps of neighbours turn one word into the other (optimal
/// string alignment distance), letters compared without case.
int edit_distance(std::string_view a, std::string_view b);

/// The choice nearest to a word that was probably misspelt, or an empty string: at most one edit in three
/// letters.
std::string nearest_name(std::string_view word, std::span<const std::string> choices);

/// "; did you mean 'x'?" with the nearest choice, or an empty string.
std::string did_you_mean(std::string_view word, std::span<const std::string> choices);

/// "'a', 'b' or 'c'" (the last word may be replaced); more than `most` names are cut: "'a', 'b' and 7 more".
std::string list_names(std::span<const std::string> names, std::string_view last_word = "or",
                       std::size_t most = 24);

}  // namespace ifov
