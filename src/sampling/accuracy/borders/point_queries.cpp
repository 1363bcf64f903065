#include "sampling/accuracy/borders/point_queries.h"

#include "sampling/accuracy/basis/label_table.h"

namespace ifov::sampling {

void PointQueries::ask(const std::vector<FocalPoint>& points, std::vector<std::uint32_t>& labels,
                       Purpose purpose) {
  first_seen_point_.resize(table_.size());
  ledger_.labels(points, labels, purpose);
  if (table_.size() <= valued_) return;
  for (std::size_t i = 0; i < labels.size() && first_seen_point_.size() < table_.size(); ++i)
    if (labels[i] == first_seen_point_.size()) first_seen_point_.push_back(points[i]);
  value_new_labels();
}

/// Values of each label that has none yet, where it was seen first.
void PointQueries::value_new_labels() {
  std::vector<FocalPoint> points;
  std::vector<std::uint32_t> wanted;
  for (auto l = static_cast<std::uint32_t>(valued_); l < table_.size(); ++l)
    if (table_.count(l) == 0 && table_.merged(l) == l) {
      points.push_back(first_seen_point_[l]);
      wanted.push_back(l);
    }
  first_values_.take(wanted, points);
  valued_ = table_.size();
}

}  // namespace ifov::sampling
