#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/document/document.h"

namespace ifov::cli {

/// What a command that reads a document takes beside its name.
struct DocumentArguments {
  std::vector<std::string> set;  ///< KEY=VALUE

  void add_to(CLI::App& parser);
  /// Throws InputError.
  std::vector<io::DocumentOverride> overrides() const;
  io::Document read(const std::string& file) const { return io::read_document(file, overrides()); }
};

}  // namespace ifov::cli
