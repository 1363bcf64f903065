#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ifov/api.h"
#include "ifov/assets.h"
#include "ifov/error.h"

namespace ifov {

struct FacadeAccess;

/// A document that is read and checked; the files of the scene that it names are not opened yet. Copies share what they
/// hold, and may be used in several threads.
class IFOV_API Document {
 public:
  /// Reads a file and what it includes. `set`: values in place of the document's, as the command line's --set takes them:
  /// "sensor.camera.orthographic.gsd=2 m", "light.sky=null".
  /// Throws InputError, located, with an excerpt; SystemError where a file cannot be read.
  static Document read(const std::filesystem::path& file, const std::vector<std::string>& set = {});

  /// The same from a text. Relative files are looked for in `folder` (empty: where the program was started), and messages
  /// call the document `name` in it.
  static Document parse(const std::string& text, const std::string& name,
                        const std::filesystem::path& folder = {}, const std::vector<std::string>& set = {});

  /// The same document with what its "asset:NAME" stand for; what is added to `assets` afterwards does not count.
  Document with_assets(const Assets& assets) const;

  /// The document for a first look: the channels of its picture alone, at most `longest_px` pixels a side over the same
  /// field of view, perfect optics, and no accuracy asked for. Throws InputError.
  Document for_preview(int longest_px) const;

  /// The document's name, as messages give it.
  std::string name() const;
  /// Where products go if nothing else is said.
  std::filesystem::path output_folder() const;

 private:
  struct Inside;
  explicit Document(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
  std::shared_ptr<const Inside> inside_;
  friend struct FacadeAccess;
};

/// The JSON Schema (draft 7) of documents, pretty-printed.
IFOV_API std::string document_schema();

/// The reference of all keys of documents, Markdown.
IFOV_API std::string document_reference();

/// As long as this lives, calls of its thread open no input file but those in a folder and below it, whatever documents name
/// and links lead to; a document that was read meanwhile stays so bound in all threads. For programs that read documents of
/// strangers. Ends where it was begun: such objects of one thread go in the reverse order of their making.
class IFOV_API InputsBelow {
 public:
  /// Throws InputError where the folder is not there.
  explicit InputsBelow(const std::filesystem::path& folder);
  ~InputsBelow();
  InputsBelow(const InputsBelow&) = delete;
  InputsBelow& operator=(const InputsBelow&) = delete;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace ifov
