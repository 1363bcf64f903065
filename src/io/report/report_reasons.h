#pragma once

#include <json/json.h>

#include <string>

#include "io/products/run_record.h"

namespace ifov::io {

/// The section with the map of reasons and its legend: what each means, its colour and how many pixels it holds for.
std::string reasons_section(const RunRecord& record);

/// Names, words and colours of the reasons and their order of gravity, for the page's script.
void add_reasons(Json::Value& meta);

}  // namespace ifov::io
