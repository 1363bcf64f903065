#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/json/node.h"

namespace ifov::io {

/// The texts of a document that name files, or might: resolved against the folder of the document that names them.
/// Where several kinds of value are possible a text that only might be a file's name is among them.
std::map<const DocumentNode*, std::string> file_names(const DocumentNode& root);

/// Those that are files or assets, each once, in the order of the names.
std::vector<std::string> existing_files(const std::map<const DocumentNode*, std::string>& names);

/// A document as one JSON text, `file_name` beside it: names of existing files are relative to its folder, or absolute
/// where they were.
std::string whole_text(const DocumentNode& root, const std::string& file_name,
                       const std::map<const DocumentNode*, std::string>& names);

}  // namespace ifov::io
