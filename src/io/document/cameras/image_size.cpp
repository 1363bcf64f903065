#include "io/document/cameras/image_size.h"

#include <array>

#include "core/format.h"
#include "io/document/schema/record.h"

namespace ifov::io {
namespace {

constexpr int kMostPixelsASide = 100000;
constexpr std::int64_t kMostPixels = 1000000000;

}  // namespace

SchemaType<ImageSize> image_size_type() {
  const auto pair = tuple<int, 2>(integer(1, kMostPixelsASide));
  return {pair.description,
          [read = pair.read](const DocumentNode& node) {
            const std::array<int, 2> size = read(node);
            if (std::int64_t{size[0]} * size[1] > kMostPixels) {
              node.fail(format("{} has {} x {} pixels, more than the {} allowed", node.title(), size[0],
                               size[1], kMostPixels));
            }
            return ImageSize{size[0], size[1]};
          },
          [write = pair.write](const ImageSize& size, Writing& writing) {
            return write({size.width_px, size.height_px}, writing);
          }};
}

}  // namespace ifov::io
