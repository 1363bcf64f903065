#pragma once

#include <string>

#include "io/document/document.h"
#include "io/document/schema/kind.h"

namespace ifov::io {

/// The table of a whole document, made once.
const Kind<Document>& whole_document_kind();

/// Where products go of a document that names no folder: its name with ".out" instead of its extension.
std::string usual_output_folder(const std::string& file_name);

}  // namespace ifov::io
