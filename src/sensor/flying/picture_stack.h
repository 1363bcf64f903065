#pragma once

#include <memory>

namespace ifov::sensor {

class Camera;

/// Of a camera whose image is made of pictures one below the other, taken one after the other: between two of them there is no scene that goes on,
/// so each is a picture of its own, to be sampled by itself through its own camera.
class PictureStack {
 public:
  virtual ~PictureStack() = default;
  virtual int lines_of_each() const = 0;
  /// Line 0 of its image is line `number * lines_of_each()` of the whole.
  virtual std::unique_ptr<const Camera> picture(int number) const = 0;
};

}  // namespace ifov::sensor
