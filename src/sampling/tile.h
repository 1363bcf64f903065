#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/run_control.h"
#include "sampling/field.h"
#include "sampling/pixel_footprint.h"
#include "sampling/reasons.h"
#include "sampling/tolerance.h"

namespace ifov::sampling {

/// Pixels [x0, x1) x [y0, y1).
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  int count() const { return width() * height(); }
};

struct TileResult;

/// All that a sampler may know about the tile it works on. Results depend on this alone.
struct TileProblem {
  PixelRect tile;   ///< the pixels whose results are wanted
  PixelRect image;  ///< all pixels there are; the halo of a tile stays within it, give or take
                    ///< the footprint's half width
  std::uint64_t seed = 0;
  const PixelFootprint* footprint = nullptr;
  const Tolerance* tolerance = nullptr;  ///< null for samplers that follow no accuracy
  std::span<const int> drivers;  ///< columns that steer decisions (at most some dozens); all are reported
  std::span<const FocalPoint>
      seeds;  ///< projected centres of compact objects smaller than a pixel, tile and halo
  std::span<const std::uint32_t>
      seed_objects;                     ///< the object of each seed (Field::object_of), where any ray that
                                        ///< meets it finds all of it, or kNoObject; empty: of none
  const CancelToken* cancel = nullptr;  ///< throws ifov::Cancelled when set
  bool keep_memory = false;             ///< fill TileResult::memory
  const TileResult* before =
      nullptr;  ///< what an earlier run of the same problem left, with its memory, at a
                ///< tolerance that is looser by a third at least
};

/// Share of a pixel's response that falls on one material, with the half-width of its interval.
struct Abundance {
  std::uint32_t pixel = 0;  ///< row-major index in the tile
  std::uint32_t material = 0;
  float fraction = 0.0f;
  float half_width = 0.0f;
};

/// One flat record per tile. Per-column arrays hold [pixel * columns + column], pixels row by row; the three that
/// speak of errors are empty where the method says nothing of its error (single ray).
struct TileResult {
  PixelRect tile;
  int columns = 0;
  std::vector<float> mean;               ///< the pixel's value: mean over its footprint
  std::vector<float> variance_geometry;  ///< variance of that mean that comes from where edges lie
  std::vector<float> variance_path;      ///< and from paths (texture, penumbra, reflections, noise)
  std::vector<float> border_share;       ///< per pixel, after drop_variances()
  std::vector<float> half_width;         ///< of the interval at the tolerance's confidence (0.95 without one)
  std::vector<std::uint32_t> samples;    ///< per pixel: all points queried (labels and values)
  std::vector<std::uint32_t> label_rays;            ///< of which label queries
  std::vector<std::uint32_t> radiance_evaluations;  ///< of which value queries
  std::vector<Reasons> reasons;    ///< why the pixel is not converged; 0 where it is: every judged half-width
                                   ///< is within its limit and nothing else speaks against it
  std::vector<float> worst_ratio;  ///< largest half-width over its limit (0 without a tolerance)
  std::vector<float>
      missable_fraction;              ///< a compact feature at least this large (fraction of a pixel's area)
                                      ///< was found with probability >= 0.95
  std::vector<Abundance> abundances;  ///< sorted by (pixel, material)
  std::vector<double>
      position_m;  ///< x, y, z in the scene of what the ray through the pixel's middle meets, not
                   ///< numbers where it meets nothing; empty where it was not asked for
  std::uint64_t halo_samples = 0;                     ///< points queried outside the tile's own pixels
  std::uint64_t seed_samples = 0, probe_samples = 0;  ///< of all points, by purpose
  RayCounts rays;  ///< as Field::counts(): of this run alone; the other counts include `before`
  std::vector<std::byte> memory;  ///< what a run at a tighter tolerance need not find out again; opaque

  void reset(PixelRect tile_pixels, int column_count, bool with_errors = true);
  /// Leaves of the two variances only what part borders have in their sum.
  void drop_variances();
  /// Largest over the columns; 1 where nothing is known.
  float share_of_borders(std::size_t pixel) const;
  bool has_errors() const { return !half_width.empty(); }
  bool converged(std::size_t pixel) const { return reasons[pixel] == 0; }
  std::int64_t converged_count() const { return std::count(reasons.begin(), reasons.end(), Reasons{0}); }
  void set(std::size_t pixel, Reason reason, bool holds = true) {
    reasons[pixel] =
        static_cast<Reasons>(holds ? reasons[pixel] | bit(reason) : reasons[pixel] & ~bit(reason));
  }
};

/// One way of turning a tile into pixel values.
class PixelSampler {
 public:
  virtual ~PixelSampler() = default;
  virtual void sample(const TileProblem& problem, Field& field, TileResult& result) const = 0;
  /// Pixels beyond the tile that the sampler looks at, besides the footprint's own half width.
  virtual int halo_px() const = 0;
  /// Whether it can go on from an earlier run of the tile to a tighter tolerance (TileProblem::before).
  virtual bool can_refine() const { return false; }
};

}  // namespace ifov::sampling
