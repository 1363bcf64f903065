#pragma once

#include <memory>

namespace ifov::sampling {

class Field;
class ImageSurvey;
struct SurveyRequest;
struct TileProblem;
struct TileResult;

/// One way of turning a tile into pixel values.
class PixelSampler {
 public:
  virtual ~PixelSampler() = default;
  virtual void sample(const TileProblem& problem, Field& field, TileResult& result) const = 0;
  /// Pixels beyond the tile that the sampler looks at, besides the footprint's own half width.
  virtual int halo_px() const = 0;
  /// Pixels are sampled in squares of so many that begin at the image's corner: one costs as much as all of its square.
  virtual int block_px() const { return 1; }
  /// What it has to know of the whole image before its first tile, found by rays of its own; null where that is nothing. The same
  /// whoever asks: every process that takes tiles of an image does.
  virtual std::unique_ptr<const ImageSurvey> survey(const SurveyRequest& request) const;
  /// Whether it can go on from an earlier run of the tile to a tighter tolerance (TileProblem::before).
  virtual bool can_refine() const { return false; }
  /// Whether no pixel rests on a few values: they may then scatter about their mean as they like, below 0 too.
  virtual bool takes_many_values() const { return false; }
  /// Whether it asks where small things outshine the scene (TileProblem::bright).
  virtual bool asks_for_bright_places() const { return false; }
};

}  // namespace ifov::sampling
