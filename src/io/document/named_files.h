#pragma once

#include <string>
#include <vector>

#include "io/document/document.h"

namespace ifov::io {

/// The files that a document names, resolved against its folder, in its order; those that are not there, and
/// folders, are left out.
std::vector<std::string> named_files(const Document& document);

}  // namespace ifov::io
