#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/tile_memory.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// What a ray is for, as the counts are reported.
enum class Purpose { trace, seed, probe };

/// Every ray of a tile goes through here: asked in large batches, counted per pixel and purpose, with a look
/// at the cancel token between batches. Labels leave as numbers of the tile's label table. Where the tile has
/// a memory, what it knows is not traced again; decisions go by the rays asked for, as if it were.
class RayLedger {
 public:
  /// `memory` may be null.
  RayLedger(Field& field, const TileProblem& problem, const Lattice& lattice, LabelTable& table,
            const AccuracyFaults& faults, TileMemory* memory)
      : field_(field),
        problem_(problem),
        lattice_(lattice),
        table_(table),
        memory_(memory),
        mask_(faults.label_mask),
        label_rays_(static_cast<std::size_t>(lattice.domain().count()), 0),
        value_rays_(label_rays_.size(), 0),
        known_labels_(label_rays_.size(), 0),
        known_values_(label_rays_.size(), 0) {}

  void labels(std::span<const FocalPoint> points, std::vector<std::uint32_t>& out, Purpose purpose) {
    out.resize(points.size());
    raw_.resize(points.size());
    const std::size_t known = memory_ != nullptr ? recall(points) : 0;
    if (known == 0)
      trace(points, raw_);
    else if (known < points.size())
      trace_unknown(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      out[i] = table_.index(raw_[i] & mask_);
      ++label_rays_[lattice_.pixel_at(points[i])];
    }
    if (memory_ != nullptr)
      for (std::size_t i = 0; i < points.size(); ++i) memory_->note(keys_[i], raw_[i]);
    if (purpose == Purpose::seed) seed_rays_ += points.size() - known;
    if (purpose == Purpose::probe) probe_rays_ += points.size() - known;
  }

  /// What the points of the last question met, label by label, whatever they stand for.
  Label own_label(std::size_t point) const { return raw_[point] & mask_; }

  /// Rows of field.stride() floats into `values`.
  void values(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
              std::span<float> values) {
    const std::size_t stride = static_cast<std::size_t>(field_.stride());
    out.resize(requests.size());
    raw_of_values_.resize(requests.size());
    for (std::size_t first = 0; first < requests.size(); first += kBatch) {
      look_for_cancel();
      const std::size_t n = std::min(kBatch, requests.size() - first);
      field_.values(requests.subspan(first, n), {raw_of_values_.data() + first, n},
                    values.subspan(first * stride, n * stride));
    }
    for (std::size_t i = 0; i < requests.size(); ++i) {
      out[i] = table_.index(raw_of_values_[i] & mask_);
      ++value_rays_[lattice_.pixel_at(requests[i].point)];
    }
  }

  /// As values, of paths that every run of the tile needs: they are kept in its memory.
  void first_values(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
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
    for (std::size_t i = 0; i < requests.size(); ++i) out[i] = table_.index(labels[i] & mask_);
  }

  /// As values, with the numbers of materials instead of labels.
  void values_and_materials(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                            std::span<float> values) {
    look_for_cancel();
    out.resize(requests.size());
    raw_of_values_.resize(requests.size());
    field_.values_and_materials(requests, raw_of_values_, values);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      out[i] = field_.material_of(raw_of_values_[i] & mask_);
      ++value_rays_[lattice_.pixel_at(requests[i].point)];
    }
  }

  /// Numbers of the objects that rays have met so far, in order.
  std::vector<std::uint32_t> objects_met() const {
    std::vector<std::uint32_t> met(table_.size());
    for (std::uint32_t l = 0; l < met.size(); ++l) met[l] = field_.object_of(table_.label(l));
    std::sort(met.begin(), met.end());
    return met;
  }

  static constexpr std::size_t kBatch = 4096;  ///< points asked at a time

  Field& field() { return field_; }
  std::uint32_t label_rays(int pixel) const { return label_rays_[pixel]; }
  std::span<const std::uint32_t> label_rays() const { return label_rays_; }
  std::uint32_t value_rays(int pixel) const { return value_rays_[pixel]; }
  std::uint32_t spent(int pixel) const { return label_rays_[pixel] + value_rays_[pixel]; }
  /// Of these, the ones that were traced in this run.
  std::uint32_t traced_labels(int pixel) const { return label_rays_[pixel] - known_labels_[pixel]; }
  std::uint32_t traced_values(int pixel) const { return value_rays_[pixel] - known_values_[pixel]; }
  std::uint64_t seed_rays() const { return seed_rays_; }
  std::uint64_t probe_rays() const { return probe_rays_; }

 private:
  void look_for_cancel() const {
    if (problem_.cancel != nullptr && problem_.cancel->cancelled()) throw Cancelled();
  }

  void trace(std::span<const FocalPoint> points, std::span<Label> labels) {
    for (std::size_t first = 0; first < points.size(); first += kBatch) {
      look_for_cancel();
      const std::size_t n = std::min(kBatch, points.size() - first);
      field_.labels(points.subspan(first, n), labels.subspan(first, n));
    }
  }

  /// Into raw_ what the memory knows of the points; returns how many.
  std::size_t recall(std::span<const FocalPoint> points) {
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

  void trace_unknown(std::span<const FocalPoint> points) {
    std::vector<FocalPoint> asked;
    for (const std::size_t i : unknown_) asked.push_back(points[i]);
    std::vector<Label> labels(asked.size());
    trace(asked, labels);
    for (std::size_t k = 0; k < unknown_.size(); ++k) raw_[unknown_[k]] = labels[k];
  }

  Field& field_;
  const TileProblem& problem_;
  const Lattice& lattice_;
  LabelTable& table_;
  TileMemory* memory_;
  Label mask_;
  std::vector<Label> raw_, raw_of_values_;
  std::vector<std::uint64_t> keys_;                         // of the points asked
  std::vector<std::size_t> unknown_;                        // of them, those that the memory does not know
  std::vector<std::uint32_t> label_rays_, value_rays_;      // asked for
  std::vector<std::uint32_t> known_labels_, known_values_;  // of these, those that the memory knew
  std::uint64_t seed_rays_ = 0, probe_rays_ = 0;
};

}  // namespace ifov::sampling
