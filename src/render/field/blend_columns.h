#pragma once

#include <cstdint>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {
class BoundedError;
struct TileResult;
}  // namespace ifov::sampling
namespace ifov::geometry {
struct SurfacePoint;
}
namespace ifov::scene {
struct Scene;
struct TruthMaterials;
}  // namespace ifov::scene

namespace ifov::render {

/// Abundances where surface assignments mix materials. A label cannot name one material there, so each material that is mixed
/// somewhere gets a column behind the channels: its share at each sample on such a surface assignment, 0 elsewhere. Samplers
/// estimate its mean and error as they do a radiance's; afterwards the columns become abundances.
class BlendColumns {
 public:
  static constexpr std::uint32_t kNoMaterial = 0xffffffffu;

  BlendColumns(const scene::Scene& scene, const scene::TruthMaterials& truth, int channels, bool all = false);

  int first_column() const { return channels_; }
  int count() const { return static_cast<int>(materials_.size()); }
  bool mixes(std::uint32_t assignment) const { return count() > 0 && mixes_[assignment] != 0; }

  /// Into the columns of one sample; `all` of what may be seen beside other things, whatever covers it.
  void write_shares(const geometry::SurfacePoint& hit, float* columns, bool all = false) const;

  /// Turns the columns of a tile, their bounds joined by `joint`, into abundances, beside those of labels, and leaves the channels alone: whatever
  /// stands behind the columns goes. Where a material stands in a pixel both by label and in a mixture, the half-widths add as independent ones do.
  void settle(const sampling::BoundedError& joint, sampling::TileResult& tile) const;

 private:
  const scene::Scene& scene_;
  int channels_;
  std::vector<std::uint32_t> materials_;           // in truth, rising, by column
  std::vector<std::uint32_t> column_of_material_;  // by the scene's material
  std::vector<std::uint8_t> mixes_;                // by surface assignment
};

}  // namespace ifov::render
