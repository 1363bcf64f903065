#include "session/assembly/geometry/motion_assembly.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/motion/motion.h"
#include "geometry/motion/moving_world.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/platform_document.h"
#include "io/document/scene_document.h"
#include "platform/trajectory.h"
#include "session/assembly/geometry/geometry_assembly.h"
#include "session/assembly/shared/scene_maps.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

class PathMotion final : public geometry::Motion {
 public:
  explicit PathMotion(platform::Trajectory path) : path_(std::move(path)) {}
  /// A body has its nose, right wing and belly for axes; what it carries is told to the right, ahead and up.
  math::Transform scene_from_carrier(double time_s) const override {
    const platform::Pose pose = path_.pose(time_s);
    return math::Transform::from_columns(pose.enu_from_body.y().v, pose.enu_from_body.x().v,
                                         -pose.enu_from_body.z().v, pose.position_m);
  }
  double step_s() const override { return path_.step_s(); }

 private:
  platform::Trajectory path_;
};

void check_covered(const platform::Trajectory& path, const GeometrySubject& exposed) {
  // A row may end where the exposure does, but for its rounding.
  const double rounding_s = 1e-9 * std::max(std::abs(exposed.from_s), std::abs(exposed.to_s));
  const double early_s = path.first_s() - exposed.from_s, late_s = exposed.to_s - path.last_s();
  const bool early = early_s > rounding_s, late = late_s > rounding_s;
  if (!early && !late) return;
  throw InputError(format("its path covers {:g} to {:g} s, and the image is exposed from {:g} to {:g} s: {}",
                          path.first_s(), path.last_s(), exposed.from_s, exposed.to_s,
                          early && late ? format("{:g} s too late and {:g} s too short", early_s, late_s)
                          : early       ? format("it begins {:g} s too late", early_s)
                                        : format("it ends {:g} s too early", late_s)));
}

}  // namespace

std::shared_ptr<const geometry::Motion> assemble_motion(const GeometrySubject& of,
                                                        const io::ObjectDocument& object,
                                                        math::Vec3 offset_m) {
  return with_position(of.sources, object.motion->position, [&] {
    const MapsOfScene maps(of.sources, of.origin);
    platform::Trajectory path =
        io::trajectory_of({*object.motion, of.time, of.origin, 1}, {offset_m, &maps}, of.from_s, of.to_s);
    check_covered(path, of);
    return std::make_shared<const PathMotion>(std::move(path));
  });
}

struct MovingObjects::Content {
  std::vector<geometry::MovingWorld::Mover> movers;
};

MovingObjects::MovingObjects() : content_(std::make_unique<Content>()) {}
MovingObjects::~MovingObjects() = default;

void MovingObjects::add(std::unique_ptr<geometry::World> body, std::shared_ptr<const geometry::Motion> motion,
                        std::uint32_t after) {
  count_ += static_cast<std::uint32_t>(body->object_count());
  content_->movers.push_back({std::move(body), std::move(motion), after});
}

std::unique_ptr<geometry::World> MovingObjects::about(std::unique_ptr<geometry::World> still,
                                                      const GeometrySubject& of) {
  if (content_->movers.empty()) return still;
  return std::make_unique<geometry::MovingWorld>(std::move(still), std::move(content_->movers), of.from_s,
                                                 of.to_s);
}

void refuse_motion(const GeometrySubject& of, const io::ObjectDocument& object, const char* why) {
  throw io::document_error(of.sources, object.motion->position, why);
}

}  // namespace ifov::session
