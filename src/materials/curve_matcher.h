#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ifov::materials {

/// The curve of a material that stands at a point, or two that share it.
struct CurveMix {
  std::uint32_t first = 0, second = 0;
  double second_share = 0.0;  ///< 0 to 1
};

/// Picks curves of a material by how far they lie from the material's mean, in standard deviations (z-scores), in
/// some spectral ranges: the algorithm of DIRSIG's texture maps (Schott et al. 1995; DIRSIG manual, "property maps"),
/// here with two neighbouring curves in place of the nearest one. See docs/theory/textures.md.
class CurveMatcher {
 public:
  enum class Distance {
    plain,       ///< between z-scores
    covariance,  ///< Mahalanobis's: ranges in which the curves vary together count once
  };

  /// `means[curve * ranges + range]`: mean of each curve in each range. Throws InputError where there are less than two
  /// curves, all have the same mean in a range, or (covariance) the means of one range follow from those of others.
  CurveMatcher(std::vector<double> means, std::size_t ranges, Distance distance = Distance::plain);

  /// For z-scores in all ranges: the nearest curve a, and with it the curve b for which the way from a to b passes
  /// closest; the share of b is that of the foot of the perpendicular. In one range these are the neighbours on either
  /// side, and beyond the outermost curve it stands alone. Curves that are equally near are drawn by `key`.
  CurveMix match(std::span<const double> scores, std::uint64_t key) const;

  std::size_t curve_count() const { return count_; }
  std::size_t range_count() const { return ranges_; }
  double mean(std::size_t range) const { return mean_[range]; }
  double deviation(std::size_t range) const { return deviation_[range]; }
  /// The curve's z-score in a range.
  double score(std::size_t curve, std::size_t range) const { return scores_[curve * ranges_ + range]; }

 private:
  CurveMix match_in_one(double score, std::uint64_t key) const;
  CurveMix match_in_many(std::span<const double> scores, std::uint64_t key) const;
  void decorrelate();
  void whiten(std::span<double> scores) const;

  std::size_t count_ = 0, ranges_ = 0;
  std::vector<double> mean_, deviation_, scores_;
  std::vector<double> points_;         ///< scores in the metric of the distance
  std::vector<double> factor_;         ///< lower Cholesky factor of the correlations; empty: plain
  std::vector<std::uint32_t> sorted_;  ///< by score, for one range
};

}  // namespace ifov::materials
