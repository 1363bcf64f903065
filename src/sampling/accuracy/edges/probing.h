#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/small_vector.h"
#include "sampling/field.h"

namespace ifov::sampling {

class EdgeTracer;
class RayLedger;
struct AccuracyOptions;

/// Looks where the lattice did not: at jittered points of every pixel, because a lattice may be in step with what it
/// looks at; at the centres of known small objects; and again at jittered points of every pixel that holds, or lies
/// beside one that holds, finer structure than the lattice announced, until enough of them find nothing new.
class Prober {
 public:
  Prober(EdgeTracer& tracer, RayLedger& ledger, const AccuracyOptions& options, std::uint64_t seed);

  /// One jittered round in every pixel of `worth`, whether or not anything is suspect: `known` points have been asked
  /// already, the others are here.
  void probe_around(const std::vector<FocalPoint>& known, const std::vector<std::uint32_t>& known_labels,
                    const std::vector<FocalPoint>& others);
  /// A side of the lattice whose ends have unlike labels that look alike, the first of them counted as `as`.
  struct Between {
    FocalPoint from, to;
    Label first, last;
    std::uint32_t as;
  };
  /// Points that have met what nothing announced, and its labels.
  struct Finds {
    std::vector<FocalPoint> points;
    std::vector<std::uint32_t> labels;
  };
  /// Halves each side until it is known where the one label goes over into the other, or what lies between them: the points
  /// where that was met, of which the model knows nothing yet.
  Finds look_between(std::vector<Between> sides);
  /// The same, and the model learns of it.
  std::vector<FocalPoint> probe_between(std::vector<Between> sides);
  /// What shows up where it was sought is no sign of anything unknown beside it.
  void take_in_expected(const std::vector<FocalPoint>& points, const std::vector<std::uint32_t>& labels);
  /// Sends pilot rays at objects that no ray has met yet.
  void follow_pilot_rays(std::span<const FocalPoint> seeds, std::span<const std::uint32_t> objects);
  /// `worth`: the pixels of the domain where a find would matter.
  void probe_until_clean(const std::vector<std::uint8_t>& worth);

  /// Sides of the jittered grids of points asked in the pixel. Any of them might have met what is still unknown.
  const std::vector<int>& grids(int pixel) const { return grids_[pixel]; }
  /// Labels that random rays, probes and pilot rays have met in the pixel, with their numbers.
  struct Met {
    std::uint32_t label, count;
  };
  std::span<const Met> met(int pixel) const { return {met_[pixel].begin(), met_[pixel].end()}; }
  /// Whether looks and probes have found more than the model can follow, or went on finding until they were spent.
  bool unsettled(int pixel) const { return unsettled_[pixel] != 0; }

 private:
  std::vector<std::uint8_t> reconcile(const std::vector<FocalPoint>& points,
                                      const std::vector<std::uint32_t>& labels);
  void note(const std::vector<FocalPoint>& points, const std::vector<std::uint32_t>& labels);
  void want_around(int pixel, int rays);
  std::vector<Met> seen_in(int pixel) const;
  void points_along_side(int pixel, int dx, int dy, const std::vector<Met>& beyond, bool clutter,
                         std::vector<FocalPoint>& points) const;
  void look_along_rim(const std::vector<std::uint8_t>& worth);
  void look_beside_clutter(const std::vector<std::uint8_t>& worth);
  void take_in(const std::vector<FocalPoint>& points, const std::vector<std::uint32_t>& labels,
               const std::vector<std::uint8_t>& contradicted);

  EdgeTracer& tracer_;
  RayLedger& ledger_;
  const AccuracyOptions& options_;
  std::uint64_t seed_;
  std::vector<std::vector<int>> grids_;
  std::vector<double> dismissed_;  // by pixel: summed contrast of what was met in cells too small to follow
  std::vector<SmallVector<Met, 2>> met_;
  std::vector<int> asked_;   // by pixel: random rays and probes
  std::vector<int> wanted_;  // by pixel: rays that must find nothing before it is left
  std::vector<std::uint8_t> unsettled_;
};

}  // namespace ifov::sampling
