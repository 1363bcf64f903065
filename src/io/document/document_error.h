#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace ifov::io {

class DocumentSource;

/// The texts that a document was read from: itself, what it includes, what the command line replaced. Positions of its values lie in them.
struct DocumentSources {
  std::string file_name;  ///< of the document, as the user gave it
  std::vector<std::shared_ptr<const DocumentSource>> texts;
};

/// An input error about something in the document, for later stages (a mesh that does not load, a map without
/// the class it needs): `message` is one sentence without a position, e.g. "mesh 'a.obj' has no faces"; the
/// result has position, message and, where the position lies in the document, its line with a caret.
InputError document_error(const DocumentSources& sources, const SourcePosition& position,
                          std::string_view message);

}  // namespace ifov::io
