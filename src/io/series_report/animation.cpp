#include "io/series_report/animation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/call_scope.h"
#include "io/figures/axes.h"
#include "io/figures/colour_scale.h"
#include "io/figures/words.h"
#include "io/series_report/gif_file.h"

namespace ifov::io {
namespace {

constexpr int kMapColours = 216, kGreys = 40, kSide = 560;  // smaller images are enlarged by whole factors
constexpr int kLeft = 16, kHead = 58, kScaleWidth = 96, kFoot = 16;
constexpr int kAll_cs = 1000, kShortest_cs = 8, kLongest_cs = 60;  // of the whole animation, of a frame

/// Colours of the scale, then greys from black to white for words.
GifFile::Palette frame_palette() {
  GifFile::Palette palette;
  for (int k = 0; k < kMapColours; ++k)
    palette.push_back(colour_at(heat_colours(), static_cast<double>(k) / (kMapColours - 1)));
  for (int k = 0; k < kGreys; ++k) {
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * k / (kGreys - 1)));
    palette.push_back({grey, grey, grey});
  }
  return palette;
}

/// The nearest colour of a palette, each sought once.
class Nearest {
 public:
  explicit Nearest(const GifFile::Palette& palette) : palette_(palette) {}
  std::uint8_t operator()(std::uint32_t rgb) {
    const auto [known, is_new] = known_.emplace(rgb, std::uint8_t{0});
    if (is_new) known->second = sought(rgb);
    return known->second;
  }

 private:
  std::uint8_t sought(std::uint32_t rgb) const {
    const int r = static_cast<int>(rgb >> 16 & 255), g = static_cast<int>(rgb >> 8 & 255),
              b = static_cast<int>(rgb & 255);
    std::size_t best = 0;
    int least = 3 * 256 * 256;
    for (std::size_t k = 0; k < palette_.size(); ++k) {
      const int dr = palette_[k].r - r, dg = palette_[k].g - g, db = palette_[k].b - b;
      const int apart = dr * dr + dg * dg + db * db;
      if (apart < least) least = apart, best = k;
    }
    return static_cast<std::uint8_t>(best);
  }
  const GifFile::Palette& palette_;
  std::map<std::uint32_t, std::uint8_t> known_;
};

}  // namespace

std::string make_animation(const Animation& animation) {
  const GifFile::Palette palette = frame_palette();
  Nearest nearest(palette);
  std::unique_ptr<GifFile> gif;
  std::vector<std::uint8_t> frame;
  int width = 0, height = 0, enlarge = 1;
  const int delay_cs =
      std::clamp(kAll_cs / static_cast<int>(animation.times.size()), kShortest_cs, kLongest_cs);
  for (std::size_t t = 0; t < animation.times.size(); ++t) {
    stop_if_cancelled();
    const Layer layer = animation.layer(t);
    enlarge = std::max(1, kSide / std::max(layer.width, layer.height));
    const int across = layer.width * enlarge, down = layer.height * enlarge;
    width = kLeft + std::max(across, 300) + kScaleWidth, height = kHead + std::max(down, 80) + kFoot;
    Canvas canvas(width, height);
    const double words = width - 2.0 * kLeft;
    canvas.text({kLeft, 24.0}, fitted(canvas, animation.title, 14.0, words), 14.0, Anchor::left, true);
    canvas.text({kLeft, 46.0}, animation.times[t], 15.0);
    const double bar = kLeft + across + 14.0;
    canvas.text({bar, kHead - 8.0}, animation.unit, 12.0);
    draw_colour_scale(canvas, heat_colours(), {animation.range.low, animation.range.high}, bar, kHead, down);
    const std::vector<std::uint32_t> sheet = canvas.pixels();
    frame.resize(sheet.size());
    std::transform(sheet.begin(), sheet.end(), frame.begin(), std::ref(nearest));
    const double span = std::max(animation.range.high - animation.range.low, 1e-9);
    constexpr auto kNothing = static_cast<std::uint8_t>(kMapColours + kGreys / 2);
    for (int y = 0; y < down; ++y)
      for (int x = 0; x < across; ++x) {
        const float value = layer.values[static_cast<std::size_t>(y / enlarge) * layer.width +
                                         static_cast<std::size_t>(x / enlarge)];
        const double share = std::clamp((static_cast<double>(value) - animation.range.low) / span, 0.0, 1.0);
        frame[static_cast<std::size_t>(kHead + y) * width + static_cast<std::size_t>(kLeft + x)] =
            std::isfinite(value) ? static_cast<std::uint8_t>(std::lround(share * (kMapColours - 1)))
                                 : kNothing;
      }
    if (!gif) gif = std::make_unique<GifFile>(width, height, palette);
    gif->add(frame, delay_cs);
  }
  return gif->finish();
}

}  // namespace ifov::io
