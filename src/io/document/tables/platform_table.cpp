#include <array>
#include <utility>
#include <vector>

#include "core/format.h"
#include "io/document/mount_document.h"
#include "io/document/platform_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/framed_place.h"
#include "io/document/tables/platform_tables.h"
#include "io/document/tables/tables.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

SchemaType<StraightPath> straight_type() {
  struct Entry {
    PlaceEntry place;
    std::array<double, 3> velocity_m_s{};
  };
  Record<Entry> record("straight path",
                       "The same velocity at all times: a straight line in space, or on the map.");
  add_place(record, &Entry::place, "position",
            "where the platform is at 0 s, which is the document's `time`");
  record.required(
      "velocity", &Entry::velocity_m_s, tuple<double, 3>(quantity(kSpeed)),
      "to the east, to the north, up: of the scene, of the map, or at a geodetic place; of ECEF along its axes");
  return converted<StraightPath>(
      record.type(),
      [](const Entry& entry) {
        return StraightPath{point_of(entry.place), entry.velocity_m_s};
      },
      [](const StraightPath& path) {
        return Entry{entry_of_point(path.at), path.velocity_m_s};
      });
}

SchemaType<FixedPath> fixed_type() {
  struct Entry {
    PlaceEntry place;
  };
  Record<Entry> record("fixed place", "It stands still, or hovers.");
  add_place(record, &Entry::place, "position", "the place");
  return converted<FixedPath>(
      record.type(), [](const Entry& entry) { return FixedPath{point_of(entry.place)}; },
      [](const FixedPath& path) { return Entry{entry_of_point(path.at)}; });
}

SchemaType<CirclingPath> circling_type() {
  struct Entry {
    PlaceEntry center;
    CirclingPath path;
  };
  const auto of = [](auto member) { return path(&Entry::path, member); };
  Record<Entry> record(
      "circling path",
      "Around a point at one speed, level in the scene. The nose is along the track, and the wings are level unless `bank` says otherwise.");
  add_place(record, &Entry::center, "center", "the circle's middle, at the path's own height");
  record
      .required("radius", of(&CirclingPath::radius_m), quantity(kLength, Range::above(0.0, "m")),
                "of the circle")
      .exactly_one()
      .one("speed", of(&CirclingPath::speed_m_s), quantity(kSpeed, Range::above(0.0, "m/s")), "along it")
      .one("period", of(&CirclingPath::period_s), quantity(kDuration, Range::above(0.0, "s")),
           "of a whole turn")
      .with_default(
          "start", of(&CirclingPath::start_rad), quantity(kAngle), "\"0 deg\"",
          "where the platform is at 0 s, which is the document's `time`: from the middle, clockwise from north")
      .with_default("direction", of(&CirclingPath::clockwise),
                    choice<bool>({{"clockwise", true}, {"counterclockwise", false}}), "\"clockwise\"",
                    "seen from above")
      .with_default(
          "bank", of(&CirclingPath::banked), choice<bool>({{"level", false}, {"coordinated", true}}),
          "\"level\"",
          "of the wings: `coordinated` is what an aircraft needs that does not slip, the inner wing down by "
          "atan(speed² / (9.80665 m/s² · radius)); `attitude`'s `roll` adds to it");
  return converted<CirclingPath>(
      record.type(),
      [](Entry entry) {
        entry.path.center = point_of(entry.center);
        return entry.path;
      },
      [](const CirclingPath& path) {
        return Entry{entry_of_point(path.center), path};
      });
}

SchemaType<WayPointPath> way_points_type() {
  struct PointEntry {
    double time_s = 0.0;
    PlaceEntry place;
  };
  struct Entry {
    WayPointPath path;
    std::vector<PointEntry> points;
  };
  Record<PointEntry> one("way point", "When a platform is where.");
  one.required("time", &PointEntry::time_s, quantity(kDuration), "after the document's `time`");
  add_coordinates(one, &PointEntry::place, "position", "where it is then");
  Record<Entry> record("way points", "A smooth curve (a cubic spline) through points.");
  record
      .required(
          "frame", path(&Entry::path, &WayPointPath::frame), earth_frame(),
          "of positions; others than the scene's need `latitude` and `longitude` of the `origin`, or a `crs`")
      .optional("crs", map_of<Entry>([](auto& entry) -> auto& { return entry.path.crs; }), map_name(),
                kMapDoc)
      .required("points", &Entry::points, list(one.type(), 1, 100000), "in the order of their times")
      .check([](const Entry& entry, const DocumentNode& node) {
        check_crs(entry.path.frame, node);
        for (std::size_t k = 0; k < entry.points.size(); ++k) {
          PlaceEntry place = entry.points[k].place;
          place.frame = entry.path.frame;
          const DocumentNode& told = node.given("points").items()[k];
          check_place(place, told, "position");
          const double time_s = entry.points[k].time_s, before_s = k > 0 ? entry.points[k - 1].time_s : 0.0;
          if (k > 0 && !(time_s > before_s))
            told.given("time").fail(
                format("found the time {:g} s after {:g} s; expected times that increase", time_s, before_s));
        }
      });
  return converted<WayPointPath>(
      record.type(),
      [](Entry entry) {
        for (PointEntry& point : entry.points) {
          point.place.frame = entry.path.frame;
          entry.path.points.push_back({point.time_s, point_of(point.place).place});
        }
        return entry.path;
      },
      [](const WayPointPath& path) {
        Entry entry{path, {}};
        for (const WayPoint& point : path.points)
          entry.points.push_back({point.time_s, entry_of_point({path.frame, point.place})});
        return entry;
      });
}

constexpr Unit kPoleUnits[] = {{"arcsec", math::kDegree / 3600.0}, {"mas", math::kDegree / 3.6e6}, {"rad"}};
const Dimension kPoleAngle{"an angle of the pole", "0.12 arcsec", kPoleUnits, 1e-15, 1.0};

/// `ut1_minus_utc` and `polar_motion`.
template <class T>
void add_turn(Record<T>& record, EarthTurnDocument T::*turn) {
  record
      .optional(
          "ut1_minus_utc", path(turn, &EarthTurnDocument::ut1_minus_utc_s),
          quantity(kDuration, Range::between(-0.9, 0.9, "s")),
          "by how much the Earth's turn is ahead of UTC, as the IERS publishes it: 0.1 s is 46 m on the equator; 0 if not given")
      .optional(
          "polar_motion", path(turn, &EarthTurnDocument::pole_rad),
          tuple<double, 2>(quantity(kPoleAngle, Range::between(-2.0, 2.0, "arcsec"))),
          "where the Earth's axis leaves it, x and y as the IERS publishes them: 0.1 arc seconds are 3 m on the ground; 0 if not given");
}

SchemaType<TablePath> path_table_type() {
  Record<TablePath> record(
      "path table", "A table of times and positions, and attitudes if it has them (docs/formats/paths.md).");
  record
      .required(
          "frame", &TablePath::frame, any_frame(),
          "of its positions and attitudes; others than the scene's need `latitude` and `longitude` of the `origin`, or a `crs`; `teme` "
          "and `gcrs` the document's `time`")
      .optional("crs", map_of<TablePath>([](auto& table) -> auto& { return table.crs; }), map_name(), kMapDoc)
      .required("file", &TablePath::file, file(), "the table, CSV");
  add_turn(record, &TablePath::turn);
  record.check([](const TablePath& table, const DocumentNode& node) {
    check_crs(table.frame, node);
    for (const char* key : {"ut1_minus_utc", "polar_motion"})
      if (!is_among_stars(table.frame) && node.find(key) != nullptr)
        node.given(key).fail_at_key(
            format("'{}' is of the frames \"teme\" and \"gcrs\", under which the Earth turns", key));
  });
  return record.type();
}

SchemaType<OrbitState> orbit_state_type() {
  Record<OrbitState> record(
      "orbit state",
      "Where the satellite was at an instant and how fast. From there it falls freely about the Earth, whose gravity is that of its mass and its "
      "zonal harmonics to the fourth: without air, Moon and Sun.");
  record
      .required("frame", &OrbitState::frame,
                choice<PathFrame>(
                    {{"gcrs", PathFrame::gcrs}, {"teme", PathFrame::teme}, {"ecef", PathFrame::ecef}}),
                "of both, Earth-centred: among the stars, or turning with the Earth")
      .required("position", &OrbitState::position_m, point(), "at the epoch")
      .required("velocity", &OrbitState::velocity_m_s, tuple<double, 3>(quantity(kSpeed)),
                "then, in m/s or km/s; of ECEF as seen from the turning Earth")
      .required("epoch", &OrbitState::epoch, time_type(), "when: at most 30 days from the document's `time`");
  return record.type();
}

SchemaType<OrbitPath> orbit_type() {
  Record<OrbitPath> record(
      "orbit",
      "Of an Earth satellite, by SGP4 from two-line elements, or from where it was and how fast. It needs the "
      "document's `time`, and `latitude` and `longitude` of the `origin`.");
  record
      .optional("frame",
                via([](OrbitPath&, int) {},
                    [](const OrbitPath& path) {
                      return std::holds_alternative<DocumentFile>(path.source) ? std::optional(0)
                                                                               : std::nullopt;
                    }),
                choice<int>({{"teme", 0}}),
                "of the file's elements, with which it must be given: that of two-line elements")
      .exactly_one()
      .one("file", &OrbitPath::source, file(), "text with the two lines, a name before them or not")
      .one("state", &OrbitPath::source, orbit_state_type(), "where it was, and how fast")
      .needs("frame", "file")
      .check([](const OrbitPath&, const DocumentNode& node) {
        if (node.find("file") != nullptr && node.find("frame") == nullptr)
          node.fail(format("{} lacks the key 'frame': 'teme'", node.title()));
      });
  add_turn(record, &OrbitPath::turn);
  return record.type();
}

}  // namespace

SchemaType<std::shared_ptr<const PlatformDocument>> motion_type() {
  Record<PlatformDocument> record(
      "motion",
      "Where something that moves is, and how it stands, over time. It is carried: its `transform` is told in axes to the right, ahead and "
      "up of what follows the path, so that it looks as in its file or table while it heads north.");
  record.exactly_one()
      .one("straight", &PlatformDocument::path, straight_type(), "the same velocity at all times")
      .one("circling", &PlatformDocument::path, circling_type(), "around a point")
      .one("way_points", &PlatformDocument::path, way_points_type(), "a curve through points")
      .one("table", &PlatformDocument::path, path_table_type(), "a curve through the points of a file")
      .optional("attitude", &PlatformDocument::attitude, platform_attitude_type(),
                "how it stands; if not given what the table says, or level, ahead along the track");
  return located<std::shared_ptr<const PlatformDocument>>(
      record.type(),
      [](PlatformDocument motion, const DocumentNode& node) {
        motion.position = node.key_position();
        return std::make_shared<const PlatformDocument>(std::move(motion));
      },
      [](const std::shared_ptr<const PlatformDocument>& motion) { return *motion; });
}

SchemaType<PlatformDocument> platform_type() {
  Record<PlatformDocument> record(
      "platform", "What carries a camera that scans: where it is and how it stands over time.");
  record.exactly_one()
      .one("straight", &PlatformDocument::path, straight_type(), "the same velocity at all times")
      .one("fixed", &PlatformDocument::path, fixed_type(), "it stands still, or hovers")
      .one("circling", &PlatformDocument::path, circling_type(), "around a point")
      .one("way_points", &PlatformDocument::path, way_points_type(), "a curve through points")
      .one("table", &PlatformDocument::path, path_table_type(), "a curve through the points of a file")
      .one("orbit", &PlatformDocument::path, orbit_type(), "of a satellite")
      .optional("attitude", &PlatformDocument::attitude, platform_attitude_type(),
                "how it stands; if not given what the table says, or level, the nose ahead")
      .optional(
          "mount",
          via(
              [](PlatformDocument& to, std::vector<MountDocument> mounts) {
                to.mounts = std::make_shared<const MountList>(MountList{std::move(mounts)});
              },
              [](const PlatformDocument& of) { return of.mounts ? &of.mounts->mounts : nullptr; }),
          mounts_type("How the camera is carried by the body, or by the mount before it in a list.", true),
          "of the camera, or a list of mounts, each on the one before; if not given at the platform's position and along its axes")
      .optional("jitter", &PlatformDocument::jitter, jitter_type(), "random turns besides")
      .optional("reported", &PlatformDocument::reported, reported_type(),
                "the pose that geolocation knows; if not given the true one");
  return record.type();
}

}  // namespace ifov::io
