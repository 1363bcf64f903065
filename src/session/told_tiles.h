#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "render/tile_sink.h"

namespace ifov::session {

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
