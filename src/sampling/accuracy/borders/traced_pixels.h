#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace ifov::sampling {

/// What tracing may spend on each pixel of the domain, and what it has noticed there; pixels by their row-major indices.
class TracedPixels {
 public:
  /// `budget`: label rays after which a pixel is clutter, at first.
  TracedPixels(int count, std::uint32_t budget)
      : allowed_variance_(static_cast<std::size_t>(count), 1.0),
        sharpened_for_(allowed_variance_.size(), 0.0),
        budget_(allowed_variance_.size(), budget),
        abandoned_(allowed_variance_.size(), 0),
        stirred_(allowed_variance_.size(), 1),
        changed_(allowed_variance_.size(), 1),
        signs_{std::vector<std::uint8_t>(allowed_variance_.size(), 0),
               std::vector<std::uint8_t>(allowed_variance_.size(), 0)} {}

  std::size_t size() const { return allowed_variance_.size(); }

  /// Variance that tracing may leave, in squares of the allowed standard error.
  double allowed_variance(std::uint32_t pixel) const { return allowed_variance_[pixel]; }
  double allowed_deviation(std::uint32_t pixel) const { return std::sqrt(allowed_variance_[pixel]); }
  void allow_variance(std::uint32_t pixel, double variance) {
    allowed_variance_[pixel] = variance;
    allowed_may_differ_ = true;
  }

  /// Lowers the number of label rays after which a pixel is clutter.
  void limit_budget(std::uint32_t pixel, double rays) {
    budget_[pixel] = static_cast<std::uint32_t>(std::min<double>(budget_[pixel], rays));
  }
  /// Leaves those pixels that have cost more label rays than that.
  void abandon_beyond_budget(std::span<const std::uint32_t> rays);

  /// Leaves this pixel as it is: no further rays.
  void abandon(std::uint32_t pixel) { abandoned_[pixel] = changed_[pixel] = 1; }
  bool abandoned(std::uint32_t pixel) const { return abandoned_[pixel] != 0; }

  /// Signs of structure that the lattice has not announced.
  struct Signs {
    std::vector<std::uint8_t> suspect;   ///< whether tracing has met anything of the kind
    std::vector<std::uint8_t> followed;  ///< finest level of cells that a feature was followed into; 0: none
  };
  const Signs& signs() const { return signs_; }
  void set_signs(Signs signs) { signs_ = std::move(signs); }
  void note_suspect(std::uint32_t pixel) { signs_.suspect[pixel] = 1; }
  bool suspect(std::uint32_t pixel) const { return signs_.suspect[pixel] != 0; }
  void note_followed(std::uint32_t pixel, int level) {
    signs_.followed[pixel] = std::max(signs_.followed[pixel], static_cast<std::uint8_t>(level));
  }
  int followed(std::uint32_t pixel) const { return signs_.followed[pixel]; }

  /// Notes that cells, curves or brackets of the pixel are not what they were.
  void stir(std::uint32_t pixel) { stirred_[pixel] = changed_[pixel] = 1; }
  /// Whether what is modelled in the pixel may differ from what it was when this was last forgotten.
  bool changed(std::uint32_t pixel) const { return changed_[pixel] != 0; }
  void forget_changes() { std::fill(changed_.begin(), changed_.end(), std::uint8_t{0}); }
  /// 1 for the pixels that were stirred, or whose allowed variance was changed, since this was last asked.
  void take_stirred(std::vector<std::uint8_t>& stirred);

 private:
  std::vector<double> allowed_variance_, sharpened_for_;  // the latter as it was when take_stirred was asked
  bool allowed_may_differ_ = true;
  std::vector<std::uint32_t> budget_;
  std::vector<std::uint8_t> abandoned_, stirred_, changed_;
  Signs signs_;
};

}  // namespace ifov::sampling
