#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace ifov::sampling {

/// A point of the focal plane in the image frame: pixel (i, j) covers [i, i+1) x [j, j+1), x to the right,
/// y downwards, in pixels. `time_s` is when light falls on it, after the middle of the exposure of its line: what the
/// camera takes for 0 where all of a line is exposed at once and nothing moves.
struct FocalPoint {
  double x_px = 0.0;
  double y_px = 0.0;
  double time_s = 0.0;
};

/// What the ray through a point meets: equal labels mean the same instance, smooth patch, material or map class,
/// facing and sun state. Opaque to samplers. Labels steer where rays go; they never enter an estimate as truth.
using Label = std::uint64_t;

/// One path: through `point`, with the random numbers of element `index` of the scrambled sequence `sequence`. Dimension pair 0 is
/// the sampler's (where in the stratum the point lies); paths use 1 and up, so that both are stratified together.
struct PathRequest {
  FocalPoint point;
  std::uint64_t sequence = 0;
  std::uint32_t index = 0;
};

/// Rays traced so far on behalf of a sampler: from the camera, one a label or value; to the Sun; leaving surfaces.
struct RayCounts {
  std::uint64_t primary = 0, shadow = 0, continuation = 0;
  std::uint64_t total() const { return primary + shadow + continuation; }
  RayCounts& operator+=(const RayCounts& other);
};

struct FieldRect;
struct KnownDetail;
class MappedSurface;
struct LevelRequests;
struct LevelSums;

/// The picture on the focal plane as a sampler sees it: two batch queries, answered in order, whose answer to a
/// point does not depend on the rest of the batch. One object serves one tile and one thread.
class Field {
 public:
  virtual ~Field() = default;

  /// Numbers in a value: the channels of the sensor. Rows are `stride` floats apart (a multiple of 16).
  virtual int columns() const = 0;
  int stride() const { return (columns() + 15) / 16 * 16; }

  /// The column, itself or one before, that decides how its values are weighed: its parts' too, so that they go on adding up to it.
  virtual int leader(int column) const { return column; }
  /// The channel whose footprint weighs a column; below 0: none's, it holds for the reference (FootprintGroups).
  virtual int channel_of(int column) const { return column; }
  virtual void labels(std::span<const FocalPoint> points, std::span<Label> labels) = 0;

  /// One path each: its label, and its radiance in every column at values[k * stride() + column].
  virtual void values(std::span<const PathRequest> requests, std::span<Label> labels,
                      std::span<float> values) = 0;

  /// The same where points are taken to show the labels `expected`, which those may be told to that do so as far as their paths tell: where a path sees the Sun, to be lit in a penumbra.
  virtual void values_expecting(std::span<const PathRequest> requests, std::span<const Label> expected,
                                std::span<Label> labels, std::span<float> values);

  /// The same where labels are asked for their material alone (material_of), which may take fewer rays.
  virtual void values_and_materials(std::span<const PathRequest> requests, std::span<Label> labels,
                                    std::span<float> values);

  /// Values as if no sunlight came straight to what the paths meet; false, and none, where the field cannot tell.
  virtual bool values_in_shadow(std::span<const PathRequest>, std::span<float>) { return false; }

  /// Means and spreads of groups of values in two levels (sampling/image/levels.h). Here: of values(), all of it direct.
  virtual void levels(const LevelRequests& requests, LevelSums& sums);

  /// What is known, without a search, of the detail of these pixels.
  virtual void known_detail(const FieldRect& pixels, KnownDetail& detail);

  /// What maps say of the surface of this label that the ray through `seen` meets, by a few rays; null: nothing that differs.
  virtual std::unique_ptr<MappedSurface> mapped_surface(Label label, const FocalPoint& seen);

  /// Index of the material a label stands on, for abundances.
  virtual std::uint32_t material_of(Label label) const = 0;

  /// Whether values of a label differ by their nature, however alike those are that were met: a penumbra's.
  virtual bool uneven(Label) const { return false; }

  /// Whether few values of a label that agree say little of others: of what the Sun or a lamp lights, which may be round.
  virtual bool may_be_shaded(Label) const { return false; }

  /// Number of the object that a label belongs to, as TileProblem::pilot_objects counts them.
  static constexpr std::uint32_t kNoObject = ~std::uint32_t{0};
  virtual std::uint32_t object_of(Label) const { return kNoObject; }
  /// Whether the border between two labels may turn sharply, as those of squares and of a map's cells do.
  virtual bool may_have_corners(Label, Label) const { return false; }

  virtual RayCounts counts() const = 0;
};

}  // namespace ifov::sampling
