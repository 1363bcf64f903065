#pragma once

#include <algorithm>
#include <vector>

namespace ifov::render {

/// How far a channel's radiance may be off because a few spectral nodes stand for it, and because temperatures that were solved
/// are what they are: the same for every path, so no number of rays makes it smaller.
struct NodeHalfWidth {
  /// Share of what is asked for up to which it is left out of intervals.
  static constexpr double kNegligible = 0.1;
  double relative = 0.0;
  double dark = 0.0;  ///< W m-2 sr-1 um-1: radiances below it may be off by as much as it
  double emitted =
      0.0;  ///< likewise: by what surfaces emit at temperatures that were solved, of the least certain material
  std::vector<double>
      emitted_of{};  ///< of pixels of one alone, by number in scene::TruthMaterials; empty: alike
  double given_up =
      0.0;  ///< of `emitted`, what rays make no room for: of materials that are less certain than is asked for

  double of(double radiance) const { return relative * std::max(radiance, dark) + emitted; }
  /// The same, `less` of it, or 0 where it is negligible beside `asked`.
  double counted(double radiance, double asked, double less = 0.0) const {
    const double half_width = of(radiance) - less;
    return half_width > kNegligible * asked ? half_width : 0.0;
  }
};

}  // namespace ifov::render
