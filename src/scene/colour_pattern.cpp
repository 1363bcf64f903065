#include "scene/colour_pattern.h"

#include <utility>

#include "geometry/surface_point.h"

namespace ifov::scene {

ColourPattern::ColourPattern(std::shared_ptr<const materials::ColourImage> image,
                             std::shared_ptr<const materials::ColourLattice> lattice, std::uint32_t state,
                             std::vector<Member> members)
    : image_(std::move(image)), lattice_(std::move(lattice)), state_(state), members_(std::move(members)) {}

void ColourPattern::apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const {
  static_assert(ResolvedSurface::kMost >= 4);
  // A surface assignment with a picture has this one state and no other pattern before it.
  if (surface.count != 1 || surface.constituents[0].state != state_) return;
  const double mapped_k = surface.constituents[0].mapped_temperature_k;
  const materials::ColourLattice::Mix mix =
      lattice_->mix(image_->at({point.position_m.x, point.position_m.y, point.u, point.v}));
  for (std::size_t k = 0; k < mix.count; ++k) {
    const Member& member = members_[mix.parts[k].corner];
    surface.constituents[k] = {member.state, member.material, mix.parts[k].share, mapped_k};
  }
  surface.count = mix.count;
}

void ColourPattern::add_maps(std::vector<const materials::NumberedMap*>& maps) const {
  maps.push_back(image_.get());
}

}  // namespace ifov::scene
