#pragma once

#include <vector>

#include "io/library/material_library.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// The materials of one table of the embedded library.
std::vector<LibraryMaterial> parse_library_table(const TextFile& file);

}  // namespace ifov::io
