#include "sampling/accuracy/border_tightening.h"

#include <algorithm>
#include <vector>

#include "sampling/accuracy/allowed_errors.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/source_grid.h"

namespace ifov::sampling {

namespace {

/// Share of what borders may take from which on they are traced more precisely: they leave a little to paths that hardly
/// vary, and a pixel that borders fill to the brim ends above its limit.
constexpr double kTight = 0.97;

}  // namespace

bool tighten_pixels(const Radiance& radiance, const SourceGrid& grid, const AllowedErrors& errors,
                    const LabelSpread& spread, const RayLedger& ledger, std::uint32_t most_samples,
                    OutputIntervals& intervals, TracedPixels& traced) {
  std::vector<double> factor(traced.size(), 1.0);
  for (const SourcePixel& pixel : radiance.pixels().others())
    for (int output : pixel.model.outputs) {
      const int source = grid.source_of(output);
      const double part = errors.border_part(source, intervals.sum(output).geometry);
      const double share = errors.geometry_share(source, spread);
      if (part > kTight * share) factor[pixel.source] = std::max(factor[pixel.source], 1.1 * part / share);
    }
  bool any = false;
  for (std::uint32_t p = 0; p < factor.size(); ++p)
    if (factor[p] > 1.0 && !traced.abandoned(p) && ledger.spent(static_cast<int>(p)) < most_samples) {
      traced.allow_variance(p, traced.allowed_variance(p) / std::min(factor[p], 16.0));
      any = true;
    }
  return any;
}

}  // namespace ifov::sampling
