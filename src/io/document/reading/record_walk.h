#pragma once

#include <vector>

#include "io/document/schema/value_description.h"

namespace ifov::io {

/// The description of a whole document.
const ValueDescription& document_description();

/// All records within a description, itself included, each name once, in the order in which a reader meets
/// them.
std::vector<const ValueDescription*> records_within(const ValueDescription& root);

}  // namespace ifov::io
