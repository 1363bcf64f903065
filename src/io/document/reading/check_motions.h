#pragma once

namespace ifov::io {

struct Document;

/// Throws InputError, with its place, where something is to move that cannot.
void check_motions(const Document& document);

}  // namespace ifov::io
