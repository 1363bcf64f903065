#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sampling/field.h"
#include "sampling/pixel_rect.h"
#include "sampling/reasons.h"

namespace ifov {
class CancelToken;
}

namespace ifov::sampling {

class BoundedError;
class BrightPlaces;
class ColumnFootprints;
class FootprintGroups;
class ImageSurvey;
class PixelFootprint;
class Tolerance;
struct LaterLight;
struct TileResult;

/// A place in the shadow of something so thin that it hides a small part of the Sun alone, `share` at most.
struct ThinShadow {
  FocalPoint point;
  float share = 0.0f;
};

/// All that a sampler may know about the tile it works on. Results depend on this alone.
struct TileProblem {
  PixelRect tile;   ///< the pixels whose results are wanted
  PixelRect image;  ///< all pixels there are; the halo of a tile stays within it, give or take
                    ///< the footprint's half width
  std::uint64_t seed = 0;
  const PixelFootprint* footprint = nullptr;
  const FootprintGroups* groups = nullptr;  ///< of channels whose footprints differ; null: that one is of all
  const Tolerance* tolerance = nullptr;     ///< null for samplers that follow no accuracy
  const LaterLight* later = nullptr;        ///< null: none
  std::span<const int>
      steering_channels;  ///< columns that steer decisions (at most some dozens); all are reported
  /// Projected centres of compact objects smaller than a pixel, of tile and halo.
  std::span<const FocalPoint> pilot_points;
  /// The object of each seed (Field::object_of), where any ray that meets it finds all of it, or kNoObject; empty: of none.
  std::span<const std::uint32_t> pilot_objects;
  std::span<const ThinShadow> thin_shadows;  ///< of tile and halo
  const BrightPlaces* bright = nullptr;      ///< of the whole image; null: none are known
  const CancelToken* cancel = nullptr;       ///< throws ifov::Cancelled when set
  bool keep_memory = false;                  ///< fill TileResult::memory
  const ImageSurvey* survey = nullptr;  ///< what PixelSampler::survey() found; null where it finds nothing
  /// What an earlier run of the same problem left, with its memory, at a tolerance that is looser by a third at least.
  const TileResult* before = nullptr;

  /// By the columns of a field. Needs a footprint; refers to it.
  ColumnFootprints footprints(const Field& field) const;
};

/// Share of a pixel's response that falls on one material, with the half-width of its interval.
struct Abundance {
  std::uint32_t pixel = 0;  ///< row-major index in the tile
  std::uint32_t material = 0;
  float fraction = 0.0f;
  float half_width = 0.0f;
};

/// What was noted of the pixels beside their radiance, of which no sampler knows. Travels with the tile as bytes.
struct TileLayer {
  std::string name;
  std::uint32_t value_bytes = 0, bands = 0;
  std::vector<std::byte> bytes;  ///< values as [pixel * bands + band]

  template <class Value>
  std::span<const Value> values() const {
    return {reinterpret_cast<const Value*>(bytes.data()), bytes.size() / sizeof(Value)};
  }
};

/// What a sampler that judges an image as a whole found of one column (docs/theory/image_sampling.md).
struct ColumnError {
  double mean_sum = 0.0;      ///< of the pixels' means
  double variance_sum = 0.0;  ///< of the pixels' variances, as the samples tell them
  float limit =
      0.0f;  ///< of the root mean square over the image; infinite: it is not judged, 0: none asked for
  float audited = 0.0f;  ///< mean squared error over those variances, by an audit; 0: there was none
};

/// One flat record per tile. Per-column arrays hold [pixel * columns + column], pixels row by row; the three that
/// speak of errors are empty where the method says nothing of its error (single ray).
struct TileResult {
  PixelRect tile;
  int columns = 0;
  std::vector<float> mean;  ///< the pixel's value: over its footprint
  /// Variance of that mean that comes from where edges lie, and from paths (texture, penumbra, reflections, noise).
  std::vector<float> variance_geometry, variance_path;
  std::vector<float> border_share;  ///< per pixel, after drop_variances()
  std::vector<float> half_width;    ///< of the interval at the tolerance's confidence (0.95 without one)
  std::vector<float> bound;  ///< while a tile is finished: how far means may be off besides; empty: not
  /// Per pixel: all points queried (labels and values); of which label queries; of which value queries.
  std::vector<std::uint32_t> samples, label_rays, radiance_evaluations;
  /// Why the pixel is not converged; 0 where it is: every judged half-width is within its limit and nothing else
  /// speaks against it.
  std::vector<Reasons> reasons;
  std::vector<float> worst_ratio;  ///< largest half-width over its limit (0 without a tolerance)
  /// A compact feature at least this large (fraction of a pixel's area) was found with probability >= 0.95.
  std::vector<float> missable_fraction;
  std::vector<Abundance> abundances;  ///< sorted by (pixel, material)
  std::vector<TileLayer> layers;
  std::vector<ColumnError> column_errors;  ///< by column; empty where pixels are judged one by one
  std::uint64_t halo_samples = 0;          ///< points queried outside the tile's own pixels
  std::uint64_t pilot_samples = 0, probe_samples = 0;  ///< of all points, by purpose
  RayCounts rays;  ///< as Field::counts(): of this run alone; the other counts include `before`
  std::vector<std::byte> memory;  ///< what a run at a tighter tolerance need not find out again; opaque

  void reset(PixelRect tile_pixels, int column_count, bool with_errors = true);
  /// Leaves of the two variances only what part borders have in their sum.
  void drop_variances();
  /// Largest over the columns; 1 where nothing is known.
  float share_of_borders(std::size_t pixel) const;
  bool has_errors() const { return !half_width.empty(); }
  void add_bound(std::size_t at, double more);
  /// The half-width of a cell with its bound; of all cells, for good.
  double joined(std::size_t at, const BoundedError& joint) const;
  void join_bounds(const BoundedError& joint);
  bool converged(std::size_t pixel) const { return reasons[pixel] == 0; }
  std::int64_t converged_count() const { return std::count(reasons.begin(), reasons.end(), Reasons{0}); }
  void set(std::size_t pixel, Reason reason, bool holds = true) {
    reasons[pixel] =
        static_cast<Reasons>(holds ? reasons[pixel] | bit(reason) : reasons[pixel] & ~bit(reason));
  }
  /// Null where there is none of this name.
  const TileLayer* layer(std::string_view name) const;

  /// Calls `visit(TileArray, array)` for every array but the layers (tile_arrays.h).
  template <class Tile, class Visit>
  static void visit_arrays(Tile& tile, const Visit& visit);
  /// "mean has 3 elements, not 12": an array or a layer that does not fit pixels and columns; empty where all do.
  std::string fault() const;
  /// Of all arrays and layers.
  std::uint64_t bytes() const;
};

}  // namespace ifov::sampling
