#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/document_source.h"

namespace ifov::io {

/// One value of a document: what it is, where it stands, the path of keys that leads to it. Readers see
/// nothing but this; the JSON library stays behind json_adapter.
class DocumentNode {
 public:
  enum class Type { null, boolean, number, text, list, object };

  DocumentNode(const DocumentNode&) = delete;
  DocumentNode& operator=(const DocumentNode&) = delete;
  DocumentNode(DocumentNode&&) = default;

  Type type() const { return type_; }
  SourcePosition position() const { return source_->position(offset_); }
  SourcePosition key_position() const { return source_->position(key_offset_); }
  const std::string& key() const { return key_; }  ///< as written; empty in lists and at the root
  /// What find() knows it by: the key, or its present name where it was written under a former one.
  std::string_view name() const { return present_name_.empty() ? std::string_view(key_) : present_name_; }
  std::size_t index() const { return index_; }  ///< in a list, as that was written
  std::string path() const;                     ///< "scene.objects[2].sphere.radius"; empty at the root
  const DocumentSource& source() const { return *source_; }

  /// Typed values; the caller has looked at type(), and another type is a bug (std::logic_error).
  bool boolean() const;
  double number() const;
  const std::string& text() const;
  const std::vector<DocumentNode>& items() const;    ///< of a list, in order; marks them as read
  const std::vector<DocumentNode>& members() const;  ///< of an object, in the document's order

  /// True for numbers written as integers that fit 64 bits.
  bool is_integer() const { return is_integer_; }
  std::int64_t integer() const;

  /// The member of that name, now marked as read; null where there is none.
  const DocumentNode* find(std::string_view key) const;
  /// The same where it is there, else this object itself: where an error about a key is shown that may not be given.
  const DocumentNode& given(std::string_view key) const;
  /// A member that was written as `former` is found as `name` from here on; `name` has to live as long as the node is
  /// read. Throws InputError where both are there.
  void take_former_name(std::string_view former, std::string_view name) const;
  bool was_read() const { return read_; }
  void mark_read() const { read_ = true; }

  /// What was found, for messages: `the number 3`, `the text "abc"`, `a list of 2`, `an object`, ...
  std::string found() const;

  /// "'scene.seed'", or "the document" at the root.
  std::string title() const;

  /// Throws InputError: "file:line:column: <message>" with an excerpt, at the value or at its key.
  [[noreturn]] void fail(std::string_view message) const;
  [[noreturn]] void fail_at_key(std::string_view message) const;

  /// fail("'path' is <found>, expected <expected>").
  [[noreturn]] void fail_expected(std::string_view expected) const;

 private:
  friend class NodeBuilder;
  friend class NodeMerger;
  DocumentNode() = default;

  const DocumentSource* source_ = nullptr;
  const DocumentNode* parent_ = nullptr;
  std::size_t offset_ = 0, key_offset_ = 0;
  std::size_t index_ = 0;  // in the parent's list
  Type type_ = Type::null;
  bool is_integer_ = false, boolean_ = false;
  mutable bool read_ = false;
  double number_ = 0.0;
  std::int64_t integer_ = 0;
  std::string key_, text_;
  mutable std::string_view present_name_;
  std::vector<DocumentNode> children_;
};

/// A parsed text and its values; moving it keeps nodes where they are.
struct DocumentTree {
  std::shared_ptr<const DocumentSource> source;
  std::unique_ptr<const DocumentNode> root;
};

/// Throws InputError at the first value that nothing has read.
void reject_unread(const DocumentNode& root);

}  // namespace ifov::io
