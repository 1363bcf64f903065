#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/tile_source.h"
#include "sampling/pixel_rect.h"
#include "sampling/reasons.h"
#include "sampling/tile.h"

namespace ifov::io {
struct RunPlan;
}

namespace ifov::session {

class RunProducts;

/// Brings tiles into a run's products line by line of the image, whether they are traced now or were kept: products whose
/// lines become whole in their order are written in large pieces.
class TileAssembly final : public render::TileSource {
 public:
  /// Reads a kept tile, from any thread; false where it is damaged.
  using Read = std::function<bool(std::size_t index, sampling::TileResult& tile)>;

  /// `kept`: tiles that can be read. `products` may be null: none are made.
  TileAssembly(const io::RunPlan& plan, std::vector<bool> kept, Read read, RunProducts* products);

  /// The next tile of the plan's share that is to be traced. Kept ones that come before it go into the products first.
  std::optional<int> next() override;

  /// A tile that was traced; from any thread.
  void write(std::size_t index, const sampling::TileResult& tile);

  /// When nothing is traced any more: the kept tiles that are not in the products yet, and gaps where there is none.
  /// `kept` as above, by now; `reason` is that of the gaps. How many could not be read.
  std::size_t finish(std::vector<bool> kept, int threads, sampling::Reason reason);

 private:
  bool take(std::size_t index);

  const io::RunPlan& plan_;
  std::vector<bool> kept_;
  Read read_;
  RunProducts* products_;
  std::vector<sampling::PixelRect> grid_;
  std::atomic<std::size_t> next_{0};
  std::vector<std::uint8_t> written_;  ///< by tile; each is one thread's
};

}  // namespace ifov::session
