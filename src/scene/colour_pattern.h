#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "materials/colour_image.h"
#include "scene/scene.h"

namespace ifov::scene {

/// Replaces a state by those of the colours that make up the colour of a picture, side by side, up to four of them.
class ColourPattern final : public Pattern {
 public:
  struct Member {
    std::uint32_t state = 0, material = 0;
  };
  /// `members` by corner of the lattice; of those that the picture has not got nothing is asked.
  ColourPattern(std::shared_ptr<const materials::ColourImage> image,
                std::shared_ptr<const materials::ColourLattice> lattice, std::uint32_t state,
                std::vector<Member> members);
  void apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const override;
  void add_maps(std::vector<const materials::NumberedMap*>& maps) const override;

 private:
  std::shared_ptr<const materials::ColourImage> image_;
  std::shared_ptr<const materials::ColourLattice> lattice_;
  std::uint32_t state_;
  std::vector<Member> members_;
};

}  // namespace ifov::scene
