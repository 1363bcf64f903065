#pragma once

#include <string>
#include <vector>

#include "io/product_parts/cube_kinds.h"
#include "io/product_parts/envi_header.h"
#include "io/product_parts/run_record.h"

namespace ifov::io {

/// Header of one cube. `statement` is the accuracy reached, in words.
EnviHeader cube_header(const CubeKind& kind, const render::ImageInfo& info, const RunIdentity& identity,
                       const std::string& statement);

/// The radiance unit as people write it.
std::string shown_unit(const std::string& unit);

/// Channels for a picture, from 0: red, green and blue where there are channels near 0.66, 0.56 and 0.48 um,
/// else the middle one.
std::vector<int> picture_channels(const render::ImageInfo& info);

}  // namespace ifov::io
