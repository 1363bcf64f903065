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

  /// W m-2 sr-1 um-1: by what surfaces emit at temperatures that were solved, of the material whose are least certain.
  double emitted = 0.0;
  /// The same of a pixel of one material, with what that shows of others; by number in scene::TruthMaterials. Empty: `emitted` of all.
  std::vector<double> emitted_of{};

  double of(double radiance) const { return of(radiance, emitted); }
  /// The same, or 0 where it is negligible beside `asked`.
  double counted(double radiance, double asked) const { return counted(radiance, asked, emitted); }
  /// With `by_emission` in place of `emitted`.
  double counted(double radiance, double asked, double by_emission) const {
    const double half_width = of(radiance, by_emission);
    return half_width > kNegligible * asked ? half_width : 0.0;
  }

 private:
  double of(double radiance, double by_emission) const {
    return relative * std::max(radiance, dark) + by_emission;
  }
};

}  // namespace ifov::render
