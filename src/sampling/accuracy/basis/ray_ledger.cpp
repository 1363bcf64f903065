#include "sampling/accuracy/basis/ray_ledger.h"

#include <algorithm>

#include "core/error.h"
#include "core/run_control.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/tile_memory.h"

namespace ifov::sampling {

RayLedger::RayLedger(Field& field, const CancelToken* cancel, const Lattice& lattice, LabelTable& table,
                     TileMemory* memory)
    : field_(field),
      cancel_(cancel),
      lattice_(lattice),
      table_(table),
      memory_(memory),
      label_rays_(static_cast<std::size_t>(lattice.domain().count()), 0),
      value_rays_(label_rays_.size(), 0),
      known_labels_(label_rays_.size(), 0),
      known_values_(label_rays_.size(), 0) {}

void RayLedger::labels(std::span<const FocalPoint> points, std::vector<std::uint32_t>& out, Purpose purpose) {
  out.resize(points.size());
  raw_.resize(points.size());
  const std::size_t known = memory_ != nullptr ? recall(points) : 0;
  if (known == 0)
    trace(points, raw_);
  else if (known < points.size())
    trace_unknown(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    out[i] = table_.index(raw_[i]);
    ++label_rays_[lattice_.pixel_at(points[i])];
  }
  if (memory_ != nullptr)
    for (std::size_t i = 0; i < points.size(); ++i) memory_->note(keys_[i], raw_[i]);
  if (purpose == Purpose::pilot) pilot_rays_ += points.size() - known;
  if (purpose == Purpose::probe) probe_rays_ += points.size() - known;
}

void RayLedger::values(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                       std::span<float> values) {
  ask(requests, out, values, [&](std::size_t first, std::size_t n, std::span<float> rows) {
    field_.values(requests.subspan(first, n), {raw_of_values_.data() + first, n}, rows);
  });
}

void RayLedger::values_expecting(std::span<const PathRequest> requests,
                                 std::span<const std::uint32_t> expected, std::vector<std::uint32_t>& out,
                                 std::span<float> values) {
  expected_.resize(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) expected_[i] = table_.label(expected[i]);
  ask(requests, out, values, [&](std::size_t first, std::size_t n, std::span<float> rows) {
    field_.values_expecting(requests.subspan(first, n), {expected_.data() + first, n},
                            {raw_of_values_.data() + first, n}, rows);
  });
}

/// Calls batch(first, count, rows) for requests in batches.
template <class Batch>
void RayLedger::ask(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                    std::span<float> values, const Batch& batch) {
  const std::size_t stride = static_cast<std::size_t>(field_.stride());
  out.resize(requests.size());
  raw_of_values_.resize(requests.size());
  for (std::size_t first = 0; first < requests.size(); first += kBatch) {
    check_cancel();
    const std::size_t n = std::min(kBatch, requests.size() - first);
    batch(first, n, values.subspan(first * stride, n * stride));
  }
  for (std::size_t i = 0; i < requests.size(); ++i) {
    out[i] = table_.index(raw_of_values_[i]);
    ++value_rays_[lattice_.pixel_at(requests[i].point)];
  }
}

void RayLedger::first_values(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                             std::span<float> values) {
  if (memory_ == nullptr) {
    this->values(requests, out, values);
    return;
  }
  const std::size_t stride = static_cast<std::size_t>(field_.stride());
  std::vector<Label> labels(requests.size());
  std::vector<PathRequest> unknown;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (memory_->knows(TileMemory::key_of(requests[i]), labels[i], &values[i * stride])) {
      ++known_values_[lattice_.pixel_at(requests[i].point)];
      ++value_rays_[lattice_.pixel_at(requests[i].point)];
      continue;
    }
    unknown.push_back(requests[i]);
    places.push_back(i);
  }
  std::vector<float> rows(unknown.size() * stride);
  this->values(unknown, out, rows);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    labels[places[k]] = raw_of_values_[k];
    std::copy_n(&rows[k * stride], stride, &values[places[k] * stride]);
    memory_->note(TileMemory::key_of(unknown[k]), raw_of_values_[k], &rows[k * stride]);
  }
  out.resize(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) out[i] = table_.index(labels[i]);
}

void RayLedger::values_and_materials(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                                     std::span<float> values) {
  check_cancel();
  out.resize(requests.size());
  raw_of_values_.resize(requests.size());
  field_.values_and_materials(requests, raw_of_values_, values);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    out[i] = field_.material_of(raw_of_values_[i]);
    ++value_rays_[lattice_.pixel_at(requests[i].point)];
  }
}

std::vector<std::uint32_t> RayLedger::objects_met() const {
  std::vector<std::uint32_t> met(table_.size());
  for (std::uint32_t l = 0; l < met.size(); ++l) met[l] = field_.object_of(table_.label(l));
  std::sort(met.begin(), met.end());
  return met;
}

void RayLedger::check_cancel() const {
  if (cancel_ != nullptr && cancel_->cancelled()) throw Cancelled();
}

void RayLedger::trace(std::span<const FocalPoint> points, std::span<Label> labels) {
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    check_cancel();
    const std::size_t n = std::min(kBatch, points.size() - first);
    field_.labels(points.subspan(first, n), labels.subspan(first, n));
  }
}

/// Into raw_ what the memory knows of the points; returns how many.
std::size_t RayLedger::recall(std::span<const FocalPoint> points) {
  keys_.resize(points.size());
  unknown_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    keys_[i] = TileMemory::key_of(points[i]);
    if (memory_->knows(keys_[i], raw_[i]))
      ++known_labels_[lattice_.pixel_at(points[i])];
    else
      unknown_.push_back(i);
  }
  return points.size() - unknown_.size();
}

void RayLedger::trace_unknown(std::span<const FocalPoint> points) {
  std::vector<FocalPoint> asked;
  for (const std::size_t i : unknown_) asked.push_back(points[i]);
  std::vector<Label> labels(asked.size());
  trace(asked, labels);
  for (std::size_t k = 0; k < unknown_.size(); ++k) raw_[unknown_[k]] = labels[k];
}

}  // namespace ifov::sampling
