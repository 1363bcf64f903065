#include "sampling/accuracy/borders/point_queries.h"

#include "sampling/accuracy/basis/label_table.h"

namespace ifov::sampling {

void PointQueries::ask(const std::vector<FocalPoint>& points, std::vector<std::uint32_t>& labels,
                       Purpose purpose) {
  ledger_.labels(points, labels, purpose);
  unseen_ += table_.size() - seen_.size();
  seen_.resize(table_.size(), 0);
  if (unseen_ == 0) return;
  std::vector<FocalPoint> at;
  std::vector<std::uint32_t> wanted;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::uint32_t label = labels[i];
    if (seen_[label] != 0) continue;
    seen_[label] = 1;
    --unseen_;
    if (table_.count(label) > 0 || table_.merged(label) != label) continue;
    at.push_back(points[i]);
    wanted.push_back(label);
  }
  first_values_.take(wanted, at);
}

bool PointQueries::may_have_corners(std::uint32_t a, std::uint32_t b) const {
  return ledger_.field().may_have_corners(table_.label(a), table_.label(b));
}

}  // namespace ifov::sampling
