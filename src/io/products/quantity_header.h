#pragma once

#include <string>

#include "io/product_parts/run_record.h"
#include "io/quantities/quantity.h"

namespace ifov::io {

/// Header of the quantity's cube. `statement` is the accuracy reached, in words.
EnviHeader header_of(const Quantity& quantity, const render::ImageInfo& image, const RunIdentity& identity,
                     const std::string& statement);

}  // namespace ifov::io
