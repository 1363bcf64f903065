#pragma once

#include <string>

#include "core/error.h"

namespace ifov::io {

/// A file that a document names: `path` is resolved against the document's folder.
struct DocumentFile {
  std::string path;
  SourcePosition position;
};

/// A name that refers to something declared elsewhere in the document (a material, a prototype, a channel).
/// parse_document has checked that it exists.
struct DocumentName {
  std::string name;
  SourcePosition position;
};

}  // namespace ifov::io
