#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ifov::session {

/// Reflectances of a mesh that were made of the colours in its file: what has to be said of them once channels are known.
struct ColourGuess {
  std::string file;                    ///< its name without folders
  std::vector<std::string> slots;      ///< whose reflectance was made so
  bool emits = false;                  ///< some of them have a temperature
  std::vector<std::uint32_t> corners;  ///< materials of the scene that pictures are mixed of
  bool beyond = false;                 ///< what lies outside of 0.38 to 0.78 um is given by the document
};

}  // namespace ifov::session
