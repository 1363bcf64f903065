#pragma once

#include <cstddef>
#include <cstdint>

#include "sampling/field.h"

namespace ifov::sampling {

class BorderModel;
class Contradictions;
class LabelTable;
struct Stratum;

/// Judges values that were planned for a stratum and came back with another label.
class StrayValues {
 public:
  StrayValues(const BorderModel& model, const Contradictions& contradictions, const LabelTable& table,
              const Field& field)
      : model_(model), contradictions_(contradictions), table_(table), field_(field) {}

  /// Whether such a value belongs to the stratum all the same. What lies on the wrong side of a border is
  /// part of the border's variance and does not; what the border cannot explain was missed by tracing: it
  /// does, as the model counts its area to the stratum, and is kept in mind.
  bool belongs(Stratum& stratum, FocalPoint point, std::uint32_t label, const float* value) const;

 private:
  const BorderModel& model_;
  const Contradictions& contradictions_;
  const LabelTable& table_;
  const Field& field_;
};

}  // namespace ifov::sampling
