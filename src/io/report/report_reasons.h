#pragma once

#include <string>

#include "io/json/json_writer.h"
#include "io/product_parts/run_record.h"

namespace ifov::io {

/// The section with the map of reasons and its legend: what each means, its colour and how many pixels it holds for.
std::string reasons_section(const RunRecord& record);

/// Names, words and colours of the reasons and their order of gravity, for the page's script.
void write_reasons(JsonWriter& json);

}  // namespace ifov::io
