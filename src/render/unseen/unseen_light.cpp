#include "render/unseen/unseen_light.h"

#include <algorithm>

#include "render/tolerance/accuracy_tolerance.h"
#include "render/unseen/widen_unseen.h"
#include "sampling/tile.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

UnseenLight::UnseenLight(const transport::SpectralScene& scene, int column) : column_(column) {
  const bool by_mirrors = scene.sun_mirrors() != nullptr && scene.sun_mirrors()->may_hide(),
             by_lobes = scene.sun_lobes() != nullptr && scene.sun_lobes()->any_throws_rarely();
  if (!by_mirrors && !by_lobes) return;
  count_ = 1;
  const radiometry::SpectralNodes& nodes = scene.nodes();
  sunlight_.assign(nodes.channel_count(), 0.0);
  for (std::size_t c = 0; c < sunlight_.size(); ++c)
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      sunlight_[c] += nodes.node_weight(n) * scene.sun_irradiance()[n] *
                      (scene.has_view_path() ? scene.view_transmittance()[n] : 1.0f);
}

void UnseenLight::settle(const AccuracyTolerance* tolerance, const sampling::LaterLight* later,
                         sampling::TileResult& tile) const {
  if (count_ == 0 || tolerance == nullptr || !tile.has_errors()) return;
  const auto columns = static_cast<std::size_t>(tile.columns), column = static_cast<std::size_t>(column_);
  const int width = tile.tile.width(), height = tile.tile.height();
  const auto at = [&](int x, int y) {
    return static_cast<double>(tile.mean[static_cast<std::size_t>(y * width + x) * columns + column]);
  };
  std::vector<double> more(sunlight_.size());
  UnseenWidening widening(*tolerance, more.size(), kNegligible, later);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double around = 0.0;
      int count = 0;
      for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) around += at(i, j), ++count;
      const double unseen = kCaution * std::max(at(x, y), around / count);
      if (!(unseen > 0.0)) continue;
      for (std::size_t c = 0; c < more.size(); ++c) more[c] = unseen * sunlight_[c];
      widening.widen(static_cast<std::size_t>(y * width + x), more, tile);
    }
}

}  // namespace ifov::render
