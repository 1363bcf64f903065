#pragma once

#include <string>

#include "io/product_parts/run_record.h"

namespace ifov::io {

/// The run record as JSON: document, version, seed, accuracy asked and reached, statistics by channel, cost,
/// files with sizes and checksums. docs/formats/products.md lists the keys. Numbers that are not finite
/// become null.
std::string to_json(const RunRecord& record);

}  // namespace ifov::io
