#pragma once

#include "io/json/json_view.h"
#include "io/json/json_writer.h"
#include "io/quantities/acquisition.h"

namespace ifov::io {

/// The members of the key "acquisition" of a run record, which docs/formats/products.md describes.
void write_members(JsonWriter& json, const Acquisition& acquisition);
Acquisition acquisition_of(const JsonView& view);

}  // namespace ifov::io
