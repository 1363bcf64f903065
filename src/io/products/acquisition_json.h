#pragma once

#include <json/json.h>

#include "io/products/acquisition.h"

namespace ifov::io {

/// The key "acquisition" of a run record, which docs/formats/products.md describes.
Json::Value to_value(const Acquisition& acquisition);
Acquisition acquisition_of(const Json::Value& value);

}  // namespace ifov::io
