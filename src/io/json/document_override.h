#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ifov::io {

/// A value in place of what a document says under a key, as the command line gives it:
/// `sensor.camera.orthographic.gsd=2 m`, `scene.objects[1].material=wall`.
struct DocumentOverride {
  struct Step {
    std::string key;        ///< of an object; empty: an item of a list
    std::size_t index = 0;  ///< of the list
  };
  std::vector<Step> steps;  ///< from the document's root, at least one
  std::string path;         ///< as written
  std::string value;  ///< JSON, or what is read as a JSON text where it is none; null takes key or item away
};

/// Throws InputError, which quotes `written` and says how it is written.
DocumentOverride read_override(std::string_view written);

}  // namespace ifov::io
