#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "sampling/accuracy/label_table.h"
#include "sampling/accuracy/lattice.h"
#include "sampling/accuracy/options.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// What a ray is for, as the counts are reported.
enum class Purpose { trace, seed, probe };

/// Every ray of a tile goes through here: asked in large batches, counted per pixel and purpose, with a look
/// at the cancel token between batches. Labels leave as numbers of the tile's label table.
class RayLedger {
 public:
  RayLedger(Field& field, const TileProblem& problem, const Lattice& lattice, LabelTable& table,
            const AccuracyFaults& faults)
      : field_(field),
        problem_(problem),
        lattice_(lattice),
        table_(table),
        mask_(faults.label_mask),
        label_rays_(static_cast<std::size_t>(lattice.domain().count()), 0),
        value_rays_(label_rays_.size(), 0) {}

  void labels(std::span<const FocalPoint> points, std::vector<std::uint32_t>& out, Purpose purpose) {
    out.resize(points.size());
    raw_.resize(points.size());
    for (std::size_t first = 0; first < points.size(); first += kBatch) {
      look_for_cancel();
      const std::size_t n = std::min(kBatch, points.size() - first);
      field_.labels(points.subspan(first, n), {raw_.data() + first, n});
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      out[i] = table_.index(raw_[i] & mask_);
      ++label_rays_[lattice_.pixel_at(points[i])];
    }
    if (purpose == Purpose::seed) seed_rays_ += points.size();
    if (purpose == Purpose::probe) probe_rays_ += points.size();
  }

  /// Rows of field.stride() floats into `values`.
  void values(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
              std::span<float> values) {
    const std::size_t stride = static_cast<std::size_t>(field_.stride());
    out.resize(requests.size());
    raw_.resize(requests.size());
    for (std::size_t first = 0; first < requests.size(); first += kBatch) {
      look_for_cancel();
      const std::size_t n = std::min(kBatch, requests.size() - first);
      field_.values(requests.subspan(first, n), {raw_.data() + first, n},
                    values.subspan(first * stride, n * stride));
    }
    for (std::size_t i = 0; i < requests.size(); ++i) {
      out[i] = table_.index(raw_[i] & mask_);
      ++value_rays_[lattice_.pixel_at(requests[i].point)];
    }
  }

  /// As values, with the numbers of materials instead of labels.
  void values_and_materials(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                            std::span<float> values) {
    look_for_cancel();
    out.resize(requests.size());
    raw_.resize(requests.size());
    field_.values_and_materials(requests, raw_, values);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      out[i] = field_.material_of(raw_[i] & mask_);
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
  std::uint64_t seed_rays() const { return seed_rays_; }
  std::uint64_t probe_rays() const { return probe_rays_; }

 private:
  void look_for_cancel() const {
    if (problem_.cancel != nullptr && problem_.cancel->cancelled()) throw Cancelled();
  }

  Field& field_;
  const TileProblem& problem_;
  const Lattice& lattice_;
  LabelTable& table_;
  Label mask_;
  std::vector<Label> raw_;
  std::vector<std::uint32_t> label_rays_, value_rays_;
  std::uint64_t seed_rays_ = 0, probe_rays_ = 0;
};

}  // namespace ifov::sampling
