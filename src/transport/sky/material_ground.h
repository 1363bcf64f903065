#pragma once

#include <memory>
#include <string>

namespace ifov::atmosphere {
class DirectionalGround;
}
namespace ifov::materials {
struct Material;
}

namespace ifov::transport {

/// Throws InputError, naming it, where light comes through the material or goes one way alone, and so it is no ground.
void check_ground(const materials::Material& material);

/// Whether it is one, and not Lambertian.
bool reflects_by_direction(const materials::Material& material);

/// A material as level ground in the air, tangent to the east; null where it is Lambertian. `sun_azimuth_rad`: of the Sun,
/// clockwise from north. Keeps the material's model. As check_ground().
std::shared_ptr<const atmosphere::DirectionalGround> material_ground(const materials::Material& material,
                                                                     double sun_azimuth_rad);

/// What the solver leaves out of such a ground, a sentence for people; empty: nothing.
std::string left_out_of(const atmosphere::DirectionalGround& ground);

}  // namespace ifov::transport
