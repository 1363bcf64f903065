#pragma once

#include <string_view>

#include "core/error.h"

namespace ifov::io {

struct Document;

/// An input error about something in the document, for later stages (a mesh that does not load, a map without
/// the class it needs): `message` is one sentence without a position, e.g. "mesh 'a.obj' has no faces"; the
/// result has position, message and, where the position lies in the document, its line with a caret.
InputError document_error(const Document& document, const SourcePosition& position, std::string_view message);

}  // namespace ifov::io
