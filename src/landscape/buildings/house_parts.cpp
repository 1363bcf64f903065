#include "landscape/buildings/house_parts.h"

#include <algorithm>

namespace ifov::landscape {

void window(MeshBuilder& mesh, Point3 sill, Facing facing, double width, double height) {
  const Vec3 out = facing.outward, up{0.0, 0.0, 1.0}, right = math::cross(up, out);
  const auto at = [&](double across, double above, double forward) {
    return sill + right * across + up * above + out * forward;
  };
  const auto bar = [&](double x0, double x1, double z0, double z1, double forward) {
    const Point3 a = at(x0, z0, 0.0), b = at(x1, z1, forward);
    mesh.box({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
             {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
  };
  const double half = 0.5 * width, frame = 0.07;
  mesh.slot("trim");
  bar(-half - frame, half + frame, -frame, 0.0, 0.08);
  bar(-half - frame, half + frame, height, height + frame, 0.05);
  bar(-half - frame, -half, 0.0, height, 0.05);
  bar(half, half + frame, 0.0, height, 0.05);
  bar(-0.02, 0.02, 0.0, height, 0.03);
  mesh.slot("window");
  mesh.quad(at(-half, 0.0, 0.02), at(half, 0.0, 0.02), at(half, height, 0.02), at(-half, height, 0.02));
}

void front_door(MeshBuilder& mesh, Point3 at) {
  mesh.slot("concrete");
  mesh.box({at.x - 0.9, at.y - 1.2, 0.0}, {at.x + 0.9, at.y, at.z});
  mesh.slot("trim");
  mesh.box({at.x - 0.58, at.y - 0.05, at.z}, {at.x + 0.58, at.y, at.z + 2.15});
  mesh.slot("door");
  mesh.box({at.x - 0.48, at.y - 0.07, at.z + 0.01}, {at.x + 0.48, at.y - 0.02, at.z + 2.06});
}

void garage_door(MeshBuilder& mesh, Point3 at, double width, double height) {
  mesh.slot("trim");
  mesh.box({at.x - 0.5 * width - 0.12, at.y - 0.04, 0.0}, {at.x + 0.5 * width + 0.12, at.y, height + 0.12});
  mesh.slot("garage door");
  constexpr int kPanels = 4;
  for (int k = 0; k < kPanels; ++k)
    mesh.box({at.x - 0.5 * width, at.y - 0.07, 0.02 + k * height / kPanels},
             {at.x + 0.5 * width, at.y - 0.02, (k + 1) * height / kPanels});
}

void chimney(MeshBuilder& mesh, Point3 base, double top) {
  mesh.slot("brick");
  mesh.box({base.x - 0.45, base.y - 0.3, base.z}, {base.x + 0.45, base.y + 0.3, top});
  mesh.slot("concrete");
  mesh.box({base.x - 0.52, base.y - 0.37, top}, {base.x + 0.52, base.y + 0.37, top + 0.08});
  mesh.slot("brick");
  for (const double x : {-0.2, 0.2})
    mesh.tube({base.x + x, base.y, top + 0.08}, {base.x + x, base.y, top + 0.4}, 0.1, 10);
}

}  // namespace ifov::landscape
