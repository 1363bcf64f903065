#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "ifov/document.h"

namespace ifov::cli {

/// What a command that reads a document takes beside its name.
struct DocumentArguments {
  std::vector<std::string> set;  ///< KEY=VALUE

  void add_to(CLI::App& parser);
  Document read(const std::string& file) const { return Document::read(file, set); }
  /// The same of one of its instruments.
  Document read(const std::string& file, const std::string& instrument) const;
};

}  // namespace ifov::cli
