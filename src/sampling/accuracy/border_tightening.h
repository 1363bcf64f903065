#pragma once

#include <cstdint>

namespace ifov::sampling {

class AllowedErrors;
class LabelSpread;
class OutputIntervals;
class Radiance;
class RayLedger;
class SourceGrid;
class TracedPixels;

/// Lowers the variance that tracing may leave in pixels whose outputs have more from borders than they may, by the sums of
/// the drivers that were gathered last; not in those that have spent `most_samples`. False where no pixel needs it.
bool tighten_pixels(const Radiance& radiance, const SourceGrid& grid, const AllowedErrors& errors,
                    const LabelSpread& spread, const RayLedger& ledger, std::uint32_t most_samples,
                    OutputIntervals& intervals, TracedPixels& traced);

}  // namespace ifov::sampling
