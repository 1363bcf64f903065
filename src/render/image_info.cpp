#include "render/image_info.h"

namespace ifov::render {

std::string what_intervals_hold(const ImageInfo& image) {
  if (image.channels.empty() || !image.channels.front().air) return {};
  return image.channels.front().air->model_counted > 0.0
             ? "intervals hold the error of the air's numbers and of its model"
             : "intervals hold the error of the air's numbers, not of its model";
}

}  // namespace ifov::render
