#include "sampling/accuracy/basis/label_table.h"

namespace ifov::sampling {

LabelTable::LabelTable(const Field& field) : LabelTable(field.columns(), 0) {
  while (deciding_ < columns_ && field.leader(static_cast<int>(deciding_)) == static_cast<int>(deciding_))
    ++deciding_;
}

std::uint32_t LabelTable::insert(Label label) {
  const auto fresh = static_cast<std::uint32_t>(labels_.size());
  indices_.find_or_insert(label, fresh);
  labels_.push_back(label);
  stands_for_.push_back(fresh);
  counts_.push_back(0);
  means_.resize(means_.size() + columns_, 0.0);
  return fresh;
}

}  // namespace ifov::sampling
