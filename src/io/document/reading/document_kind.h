#pragma once

#include <string>

#include "io/document/schema/schema_type.h"

namespace ifov::io {

struct Document;

/// The table of a whole document, made once.
const SchemaType<Document>& whole_document_type();

/// Where products go of a document that names no folder: its name with ".out" instead of its extension.
std::string usual_output_folder(const std::string& file_name);

}  // namespace ifov::io
