#pragma once

namespace ifov::render {

/// How much a label says.
enum class LabelDetail {
  material,   ///< instance, patch, material, facing: no further rays
  sun_state,  ///< and how the Sun's disc is seen, by rays to fixed points of it, and what mirrors throw of it
};

}  // namespace ifov::render
