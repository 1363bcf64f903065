#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/label_values.h"

namespace ifov::sampling {

class Contrast;

/// Asks for the labels of points, a batch at a time, and for first values of each label that is new.
class PointQueries {
 public:
  PointQueries(RayLedger& ledger, LabelTable& table, Contrast& contrast, std::uint64_t seed)
      : ledger_(ledger), table_(table), first_values_(ledger, table, contrast, seed) {}

  /// The next batch, to be filled; empty after each question.
  std::vector<FocalPoint>& points() { return points_; }
  /// Labels of the batch, in order, until the next question.
  const std::vector<std::uint32_t>& ask() {
    ask(points_, labels_, Purpose::trace);
    points_.clear();
    return labels_;
  }

  /// Field::may_have_corners of labels by their numbers.
  bool may_have_corners(std::uint32_t a, std::uint32_t b) const;

  /// Labels of other points.
  void ask(const std::vector<FocalPoint>& points, std::vector<std::uint32_t>& labels, Purpose purpose);

 private:
  RayLedger& ledger_;
  LabelTable& table_;
  LabelValues first_values_;
  std::vector<FocalPoint> points_;
  std::vector<std::uint32_t> labels_;
  std::vector<std::uint8_t> seen_;  // by label: whether a question has met it; values meet labels too
  std::size_t unseen_ = 0;
};

}  // namespace ifov::sampling
