#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "render/tile_sink.h"
#include "render/tile_source.h"

namespace ifov::session {

/// A mean over an image, from a part of it.
struct Mean {
  double value = 0.0;  ///< per pixel
  double error = 0.0;  ///< relative standard error
};

/// Hands out pieces that are spread over an image until the mean cost of a pixel is known well enough, or time is up, and
/// notes what each takes. Times are those of the processor, so that others who use the machine do not count.
class Probing final : public render::TileSource, public render::TileSink, public render::EarlierTiles {
 public:
  struct Image {
    int columns = 0, rows = 0;  ///< of pieces
    double pixels = 0.0;
    /// What lies in the surroundings of a whole tile, as a share of what lies in those of a piece, per pixel.
    double surroundings = 1.0;
  };
  /// `chunks_made`: how many chunks of large meshes have trees by now. `earlier`: of the run that is to be refined; null
  /// where there is none.
  Probing(const Image& image, std::function<std::size_t()> chunks_made, render::EarlierTiles* earlier);

  std::optional<int> next() override;
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override;
  bool read(std::size_t index, sampling::TileResult& tile) override;

  /// These are of a run of whole tiles.
  Mean rays() const;
  Mean processor_s() const;
  double memory_bytes_per_pixel() const;  ///< that samplers keep for a tighter accuracy
  /// Chunks that will have trees, of `all`: what the later half of the pieces found that the earlier had not, as if
  /// each further half found less by the same factor.
  double chunks(std::size_t all) const;

  std::size_t count() const { return probes_.size(); }
  double share() const { return pixels_ / image_.pixels; }
  /// Of the process, until the first piece was asked for.
  double setup_s() const { return setup_s_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Probe {
    double pixels = 0.0, rays = 0.0, seconds = 0.0, memory = 0.0;
    double halo_share = 0.0;  ///< of its samples
    double chunks = 0.0;      ///< with trees when it was done
  };
  template <class Cost>
  Mean mean(const Cost& cost) const;
  bool is_enough() const;

  Image image_;
  std::function<std::size_t()> chunks_made_;
  render::EarlierTiles* earlier_;
  std::vector<int> order_;
  std::size_t next_ = 0;
  std::mutex mutex_;
  Clock::time_point begin_ = Clock::now();
  double setup_s_ = 0.0, pixels_ = 0.0;
  struct Begun {
    double at_s = 0.0, earlier_rays = 0.0;
  };
  std::map<std::thread::id, Begun> begun_;
  std::vector<Probe> probes_;
};

/// Processor time of this process so far, all threads.
double process_s();

}  // namespace ifov::session
