#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ifov/api.h"
#include "ifov/error.h"

namespace ifov {

/// A document that is read and checked; the files of the scene that it names are not opened yet. Copies share what they
/// hold, and may be used in several threads.
class IFOV_API Document {
 public:
  /// Reads a file and what it includes. `set`: values in place of the document's, as the command line's --set takes them:
  /// "sensor.camera.orthographic.gsd=2 m", "light.sky=null".
  /// Throws InputError, located, with an excerpt; EnvironmentError where a file cannot be read.
  static Document read(const std::filesystem::path& file, const std::vector<std::string>& set = {});

  /// The same from a text. Relative files are looked for in `folder` (empty: where the program was started), and messages
  /// call the document `name` in it.
  static Document parse(const std::string& text, const std::string& name,
                        const std::filesystem::path& folder = {}, const std::vector<std::string>& set = {});

  /// The document's name, as messages give it.
  std::string name() const;
  /// Where products go if nothing else is said.
  std::filesystem::path output_folder() const;

 private:
  struct Inside;
  explicit Document(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
  std::shared_ptr<const Inside> inside_;
  friend class Simulation;
};

/// The JSON Schema (draft 7) of documents, pretty-printed.
IFOV_API std::string document_schema();

/// From now on this process, in all of its threads, opens no input file but those in this folder and below it, whatever
/// documents name and links lead to; it cannot be taken back. For programs that read documents of strangers.
/// Throws InputError where the folder is not there.
IFOV_API void confine_inputs(const std::filesystem::path& folder);

}  // namespace ifov
