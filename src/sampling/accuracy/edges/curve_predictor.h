#pragma once

#include <cstdint>

namespace ifov::sampling {

class BorderModel;
class Contrast;
class Dither;
class NarrowFeatures;
class TracedPixels;
struct CurveCheck;

/// Where the middle of a curve should be, by its ends and the neighbouring curves, and whether a ray is worth it to see.
class CurvePredictor {
 public:
  CurvePredictor(const BorderModel& model, const NarrowFeatures& features, const Contrast& contrast,
                 const TracedPixels& pixels, const Dither& dither, std::uint64_t seed)
      : model_(model),
        features_(features),
        contrast_(contrast),
        pixels_(pixels),
        dither_(dither),
        seed_(seed) {}

  enum class Verdict {
    look,    ///< rays have to confirm it, as the check says
    accept,  ///< the tolerance bears what it may be off by
    split,   ///< too bent for one curve, and too much to be left so
  };
  /// Fills in a check of which no more than the cell is known.
  Verdict predict(CurveCheck& check) const;

 private:
  const BorderModel& model_;
  const NarrowFeatures& features_;
  const Contrast& contrast_;
  const TracedPixels& pixels_;
  const Dither& dither_;
  std::uint64_t seed_;
};

}  // namespace ifov::sampling
