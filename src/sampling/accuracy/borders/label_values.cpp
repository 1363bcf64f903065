#include "sampling/accuracy/borders/label_values.h"

#include <algorithm>
#include <vector>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/hash.h"

namespace ifov::sampling {

void LabelValues::take(std::span<const std::uint32_t> labels, std::span<const FocalPoint> points) {
  if (labels.empty()) return;
  std::vector<PathRequest> requests;
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Label label = table_.label(labels[i]);
    const std::uint32_t paths = ledger_.field().uneven(label) ? kOfUneven : 1;
    for (std::uint32_t k = 0; k < paths; ++k)
      requests.push_back({points[i], hash(seed_, label, 0x6e6577), k});
    ends.push_back(requests.size());
  }
  std::vector<std::uint32_t> met;
  const std::size_t stride = static_cast<std::size_t>(ledger_.field().stride());
  std::vector<float> values(requests.size() * stride);
  ledger_.first_values(requests, met, values);
  std::vector<double> mean(table_.columns()), variance(table_.columns());
  std::size_t first = 0;
  for (std::size_t i = 0; i < labels.size(); first = ends[i++]) {
    for (std::size_t k = first; k < ends[i]; ++k) table_.add(labels[i], &values[k * stride]);
    const auto count = static_cast<double>(ends[i] - first);
    if (count < 2.0) continue;
    std::fill(mean.begin(), mean.end(), 0.0);
    std::fill(variance.begin(), variance.end(), 0.0);
    for (std::size_t k = first; k < ends[i]; ++k)
      for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += values[k * stride + c] / count;
    for (std::size_t k = first; k < ends[i]; ++k)
      for (std::size_t c = 0; c < mean.size(); ++c) {
        const double difference = values[k * stride + c] - mean[c];
        variance[c] += difference * difference / (count - 1.0);
      }
    contrast_.widen_spread(labels[i], variance);
  }
}

}  // namespace ifov::sampling
