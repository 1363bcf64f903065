#pragma once

#include <vector>

#include "core/run_control.h"

namespace ifov::render {

struct RenderJob;
class TileSink;

/// An image of one time of a series.
struct ImageOfTime {
  const RenderJob& job;
  TileSink* sink;
  ProgressSink* progress;
  std::vector<bool> wanted;  ///< by tile; empty: none
};

}  // namespace ifov::render
