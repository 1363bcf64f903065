#include "sampling/accuracy/borders/point_queries.h"

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/hash.h"

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

/// One value of each label that has none yet, where it was seen first. The values may bring labels of their
/// own, whose turn comes with the next question.
void PointQueries::value_new_labels() {
  std::vector<PathRequest> requests;
  std::vector<std::uint32_t> wanted;
  for (auto l = static_cast<std::uint32_t>(valued_); l < table_.size(); ++l)
    if (table_.count(l) == 0 && table_.merged(l) == l) {
      requests.push_back({first_seen_point_[l], hash(seed_, table_.label(l), 0x6e6577), 0});
      wanted.push_back(l);
    }
  valued_ = table_.size();
  if (requests.empty()) return;
  std::vector<std::uint32_t> labels;
  const std::size_t stride = static_cast<std::size_t>(ledger_.field().stride());
  std::vector<float> values(requests.size() * stride);
  ledger_.first_values(requests, labels, values);
  for (std::size_t i = 0; i < wanted.size(); ++i) table_.add(wanted[i], &values[i * stride]);
  first_seen_point_.resize(table_.size(), requests.back().point);
}

}  // namespace ifov::sampling
