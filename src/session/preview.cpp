#include "session/preview.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "core/format.h"
#include "core/parallel.h"
#include "core/version.h"
#include "io/document/document.h"
#include "io/product_parts/run_record.h"
#include "io/products/quicklook.h"
#include "render/field/make_field.h"
#include "render/image_renderer.h"
#include "sampling/field.h"
#include "sampling/hash.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCoarsest = 8;        // pixels between the first paths
constexpr std::size_t kBatch = 64;  // paths between two looks at the clock
constexpr int kMostPaths = 256;     // at a pixel
constexpr double kPatience = 10.0;  // times the time asked for, until every pixel has a path

class Painter {
 public:
  Painter(const Parts& parts, const PreviewOptions& options)
      : parts_(parts),
        options_(options),
        width_(parts.camera->width_px()),
        height_(parts.camera->height_px()),
        channels_(parts.channels.size()),
        sum_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * channels_, 0.0f),
        paths_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0),
        fields_(static_cast<std::size_t>(options.threads > 0 ? options.threads : usual_threads())),
        start_(Clock::now()) {}

  void paint() {
    for (int step = kCoarsest; step >= 1; step /= 2)
      if (!pass(step, kPatience)) return;
    while (paths_.front() < kMostPaths)
      if (!pass(1, 1.0)) return;
  }

  /// Pixels without a path of their own take the next one of a coarser pass to the upper left.
  float value(int x, int y, std::size_t channel) const {
    for (int step = 1; step <= kCoarsest; step *= 2) {
      const std::size_t pixel = index(x / step * step, y / step * step);
      if (paths_[pixel] > 0) return sum_[pixel * channels_ + channel] / static_cast<float>(paths_[pixel]);
    }
    return std::numeric_limits<float>::quiet_NaN();
  }

  std::string statement() const {
    const auto [least, most] = std::minmax_element(paths_.begin(), paths_.end());
    const std::string count = *least == *most ? format("{}", *least) : format("{} to {}", *least, *most);
    std::string without;
    const std::vector<std::string>& left_out = parts_.document.left_out;
    for (std::size_t k = 0; k < left_out.size(); ++k)
      without += (k == 0 ? " The sensor's " : k + 1 < left_out.size() ? ", " : " and ") + left_out[k];
    if (!without.empty()) without += left_out.size() == 1 ? " is left out." : " are left out.";
    return format("A preview: {} path{} at each pixel. It promises no accuracy.{}", count,
                  *most == 1 ? "" : "s", without);
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  double passed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// One more path at every pixel of a coarser image, or, with step 1, of this one. False where time is over.
  bool pass(int step, double patience) {
    std::vector<std::size_t> pixels;
    const bool first = step > 1 || paths_[index(std::min(1, width_ - 1), std::min(1, height_ - 1))] == 0;
    for (int y = 0; y < height_; y += step)
      for (int x = 0; x < width_; x += step)
        if (!first || paths_[index(x, y)] == 0) pixels.push_back(index(x, y));
    std::atomic<std::size_t> next{0};
    std::atomic<bool> over{false};
    parallel_for(
        static_cast<std::int64_t>(fields_.size()), static_cast<int>(fields_.size()),
        [&](std::int64_t thread) {
          std::unique_ptr<sampling::Field>& field = fields_[static_cast<std::size_t>(thread)];
          if (!field)
            field = render::make_field(*parts_.spectral_scene, *parts_.camera, parts_.job().transport,
                                       render::LabelDetail::material, parts_.job().polarimetry);
          while (!over) {
            if (options_.cancel != nullptr && options_.cancel->cancelled()) throw Cancelled();
            if (passed() > patience * options_.seconds) over = true;
            const std::size_t begin = next.fetch_add(kBatch);
            if (begin >= pixels.size()) return;
            if (!over)
              trace(*field, std::span(pixels).subspan(begin, std::min(kBatch, pixels.size() - begin)));
          }
        });
    return !over;
  }

  void trace(sampling::Field& field, std::span<const std::size_t> pixels) {
    std::vector<sampling::PathRequest> requests;
    for (const std::size_t pixel : pixels) {
      // Additive recurrence, beginning in the middle: Roberts, M. (2018), R2 sequence.
      const double n = paths_[pixel];
      const double u = std::fmod(0.5 + 0.7548776662466927 * n, 1.0),
                   v = std::fmod(0.5 + 0.5698402909980532 * n, 1.0);
      const double x = static_cast<double>(pixel % static_cast<std::size_t>(width_)),
                   y = static_cast<double>(pixel / static_cast<std::size_t>(width_));
      requests.push_back({{x + u, y + v}, sampling::hash(parts_.document.seed, pixel, paths_[pixel]), 0});
    }
    const auto stride = static_cast<std::size_t>(field.stride());
    std::vector<sampling::Label> labels(pixels.size());
    std::vector<float> values(pixels.size() * stride);
    field.values(requests, labels, values);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      for (std::size_t c = 0; c < channels_; ++c) sum_[pixels[k] * channels_ + c] += values[k * stride + c];
      ++paths_[pixels[k]];
    }
  }

  const Parts& parts_;
  const PreviewOptions& options_;
  int width_, height_;
  std::size_t channels_;
  std::vector<float> sum_;
  std::vector<std::uint32_t> paths_;
  std::vector<std::unique_ptr<sampling::Field>> fields_;
  Clock::time_point start_;
};

}  // namespace

Preview make_preview(const Parts& parts, const PreviewOptions& options) {
  Painter painter(parts, options);
  painter.paint();
  const int width = parts.camera->width_px(), height = parts.camera->height_px();
  const io::RasterView view{width, height, static_cast<int>(parts.channels.size()),
                            [&](int line, int band, std::span<float> values) {
                              for (int x = 0; x < width; ++x)
                                values[static_cast<std::size_t>(x)] =
                                    painter.value(x, line, static_cast<std::size_t>(band));
                            }};
  io::RunRecord record;
  record.identity.version = version();
  record.outcome.accuracy_statement = painter.statement();
  record.image = parts.info;
  Preview preview;
  preview.statement = painter.statement();
  preview.png = io::make_quicklook(view, record, {});
  io::PictureColours colours = io::picture_colours(view, record, {});
  preview.width_px = colours.width, preview.height_px = colours.height;
  preview.pixels = std::move(colours.pixels);
  return preview;
}

}  // namespace ifov::session
