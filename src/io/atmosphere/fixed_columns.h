#pragma once

#include <string_view>
#include <vector>

#include "io/tables/text_table.h"

namespace ifov::io {

/// Cells of a line whose columns are flush with the right ends of their headings (counted in characters from
/// 0, one past the last). Blank cells have an empty text. A word is the cell of the heading whose end is
/// nearest (within `slack` characters); numbers that touch are cut at the ends of the headings. Words to the
/// right of all headings are left out. Throws InputError where two words fall into one column or a word into
/// none.
std::vector<Field> cells_under(const TextFile& file, int line, const std::vector<std::size_t>& ends,
                               std::size_t slack = 4);

}  // namespace ifov::io
