#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "io/product_parts/image_error.h"
#include "render/tile_sink.h"
#include "sampling/reason_words.h"

namespace ifov::io {
struct RunPlan;
}  // namespace ifov::io

namespace ifov::session {

struct Parts;

/// What was loaded, a few lines for people.
std::string describe(const Parts& parts);

/// "sensor: 400 x 300 pixels, 3 channels in 4 spectral nodes"
std::string sensor_statement(const Parts& parts);

/// What was asked for, what was reached, and where it was not and why; `reasons` counts the pixels that are done and not
/// converged, `why_gaps` says why pixels are not done, where some are not; `errors` of the image, where it is judged as a whole or
/// audited.
std::string accuracy_statement(const io::RunPlan& plan, const Progress& totals,
                               const sampling::ReasonCounts& reasons, const std::string& why_gaps,
                               const std::vector<io::ImageError>& errors = {});

/// Floors and assumptions that enter the result.
std::vector<std::string> notes(const Parts& parts);

/// Passes tiles on and keeps what is needed to say what could have been missed.
class DetectionTally final : public render::TileSink {
 public:
  explicit DetectionTally(render::TileSink& next);
  void begin(const render::ImageInfo& info) override { next_.begin(info); }
  void write(const sampling::TileResult& tile) override;
  std::string statement() const;

 private:
  render::TileSink& next_;
  std::mutex mutex_;
  std::vector<std::uint64_t> pixels_;  ///< by missable fraction, in steps of 1/2048 of its size
  std::uint64_t count_ = 0;
};

/// Passes tiles on and notes whether any pixel differs from another.
class OneValue final : public render::TileSink {
 public:
  explicit OneValue(render::TileSink& next) : next_(next) {}
  void begin(const render::ImageInfo& info) override { next_.begin(info); }
  void write(const sampling::TileResult& tile) override;
  /// Whether there is more than one pixel, and all hold the same in every channel but for rounding.
  bool holds() const;

 private:
  render::TileSink& next_;
  std::mutex mutex_;
  std::vector<float> least_, most_;  ///< by channel, of pixels that hold a value
  std::int64_t pixels_ = 0;          ///< that do
};

}  // namespace ifov::session
