#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "session/runs/run.h"

namespace ifov::session {

/// What a run will take.
struct Forecast {
  double rays = 0.0;
  double elapsed_s = 0.0;    ///< from the loaded scene to whole products, where nobody else uses the cores
  double processor_s = 0.0;  ///< of all threads, for the same
  double uncertainty = 0.0;  ///< relative standard error of these, from how unlike the probes are
  std::uint64_t memory_bytes = 0;   ///< at most at a time
  std::uint64_t disk_bytes = 0;     ///< while the run works: products and kept tiles
  std::uint64_t product_bytes = 0;  ///< of which stay
  std::size_t probes = 0;           ///< none where there is too little memory to probe
  double probed_share = 0.0;        ///< of the image
  double probing_s = 0.0;
  std::vector<std::string> shortages;  ///< "out: the run takes 3.1 TB, 0.2 TB are free"; none: it will do
};

/// Renders a few small pieces spread over the image, at the document's settings, and scales up. Takes seconds
/// to a minute. Throws Cancelled, and what a run would throw that may not keep or refine.
Forecast forecast_run(const Session& session, const RunRequest& request);

}  // namespace ifov::session
