#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/field.h"

namespace ifov {
class CancelToken;
}

namespace ifov::sampling {

class LabelTable;
class Lattice;
class TileMemory;

/// What a ray is for, as the counts are reported.
enum class Purpose { trace, pilot, probe };

/// Every ray of a tile goes through here: asked in large batches, counted per pixel and purpose, with a look
/// at the cancel token between batches. Labels leave as numbers of the tile's label table. Where the tile has
/// a memory, what it knows is not traced again; decisions go by the rays asked for, as if it were.
/// All questions throw Cancelled.
class RayLedger {
 public:
  /// `cancel` and `memory` may be null.
  RayLedger(Field& field, const CancelToken* cancel, const Lattice& lattice, LabelTable& table,
            TileMemory* memory);

  void labels(std::span<const FocalPoint> points, std::vector<std::uint32_t>& out, Purpose purpose);

  /// What the points of the last question met, label by label, whatever they stand for.
  Label own_label(std::size_t point) const { return raw_[point]; }

  /// Rows of field.stride() floats into `values`.
  void values(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
              std::span<float> values);

  /// As values, of points that are taken to show the labels of these numbers (Field::values_expecting).
  void values_expecting(std::span<const PathRequest> requests, std::span<const std::uint32_t> expected,
                        std::vector<std::uint32_t>& out, std::span<float> values);

  /// As values, of paths that every run of the tile needs: they are kept in its memory.
  void first_values(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                    std::span<float> values);

  /// As values, with the numbers of materials instead of labels.
  void values_and_materials(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out,
                            std::span<float> values);

  /// Numbers of the objects that rays have met so far, in order.
  std::vector<std::uint32_t> objects_met() const;

  static constexpr std::size_t kBatch = 4096;  ///< points asked at a time

  Field& field() { return field_; }
  std::span<const std::uint32_t> label_rays() const { return label_rays_; }
  std::uint32_t spent(int pixel) const { return label_rays_[pixel] + value_rays_[pixel]; }
  /// Of these, the ones that were traced in this run.
  std::uint32_t traced_labels(int pixel) const { return label_rays_[pixel] - known_labels_[pixel]; }
  std::uint32_t traced_values(int pixel) const { return value_rays_[pixel] - known_values_[pixel]; }
  std::uint64_t pilot_rays() const { return pilot_rays_; }
  std::uint64_t probe_rays() const { return probe_rays_; }

 private:
  template <class Batch>
  void ask(std::span<const PathRequest> requests, std::vector<std::uint32_t>& out, std::span<float> values,
           const Batch& batch);
  void check_cancel() const;
  void trace(std::span<const FocalPoint> points, std::span<Label> labels);
  std::size_t recall(std::span<const FocalPoint> points);
  void trace_unknown(std::span<const FocalPoint> points);

  Field& field_;
  const CancelToken* cancel_;
  const Lattice& lattice_;
  LabelTable& table_;
  TileMemory* memory_;
  std::vector<Label> raw_, raw_of_values_, expected_;
  std::vector<std::uint64_t> keys_;                         // of the points asked
  std::vector<std::size_t> unknown_;                        // of them, those that the memory does not know
  std::vector<std::uint32_t> label_rays_, value_rays_;      // asked for
  std::vector<std::uint32_t> known_labels_, known_values_;  // of these, those that the memory knew
  std::uint64_t pilot_rays_ = 0, probe_rays_ = 0;
};

}  // namespace ifov::sampling
