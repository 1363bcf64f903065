#pragma once

namespace ifov::io {

struct Document;

/// Holds what one table of keys alone cannot: every name that the document refers to is declared in it, names
/// of channels are unique, and what the Sun's direction follows from is there. Throws InputError.
void check_references(const Document& document);

}  // namespace ifov::io
