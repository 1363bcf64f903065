#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/document/node.h"

namespace ifov::cli {

/// Looks through a run record that may lack anything.
class Record {
 public:
  explicit Record(const io::DocumentNode* node) : node_(node) {}

  Record operator[](const std::string& key) const;
  /// "?" where there is none.
  std::string text() const;
  /// 0 where there is none.
  double number() const { return is_number() ? node_->number() : 0.0; }
  bool is_number() const { return node_ != nullptr && node_->type() == io::DocumentNode::Type::number; }
  std::vector<Record> items() const;

 private:
  const io::DocumentNode* node_;
};

/// The record of a run (NAME_run.json).
class RunRecordFile {
 public:
  /// EnvironmentError where it cannot be read, InputError where it is none.
  explicit RunRecordFile(const std::filesystem::path& path);
  Record root() const { return Record(tree_.root.get()); }

 private:
  io::DocumentTree tree_;
};

}  // namespace ifov::cli
