#include <algorithm>

#include "core/format.h"
#include "geodesy/utc_seconds.h"
#include "io/document/presence_document.h"
#include "io/document/scene_document.h"
#include "io/document/schema/record.h"
#include "io/document/schema/shared_target.h"
#include "io/document/shapes/primitive.h"
#include "io/document/tables/map_tables.h"
#include "io/document/tables/shape_tables.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostObjects = 1000000, kMostIntervals = 10000;

SchemaType<TransformDocument> transform_type() {
  struct Rotation {
    math::Vec3 axis;
    double angle_rad = 0.0;
  };
  using Factors = std::array<double, 3>;
  Record<Rotation> rotation("rotation", "Right-handed, about an axis through the object's origin.");
  rotation.with_default("axis", &Rotation::axis, direction(), "[0, 0, 1]", "its axis, any length")
      .required("angle", &Rotation::angle_rad, quantity(kAngle), "its angle");
  const SchemaType<double> factor = number(Range::above(0.0));
  const auto uniform = converted<math::Vec3>(
      factor,
      [](double s) {
        return math::Vec3{s, s, s};
      },
      [](math::Vec3 s) { return s.x == s.y && s.y == s.z ? std::optional(s.x) : std::nullopt; });
  const auto by_axis = converted<math::Vec3>(
      tuple<double, 3>(factor),
      [](const Factors& s) {
        return math::Vec3{s[0], s[1], s[2]};
      },
      [](math::Vec3 s) {
        return Factors{s.x, s.y, s.z};
      });
  Record<TransformDocument> record("transform", "First scale, then rotate, then translate.");
  record
      .optional("translate", &TransformDocument::translate_m, displacement(),
                "shift to the east, north and up")
      .optional("rotate",
                via(
                    [](TransformDocument& t, Rotation r) {
                      t.rotation_axis = r.axis;
                      t.rotation_rad = r.angle_rad;
                    },
                    [](const TransformDocument& t) {
                      return t.rotation_rad != 0.0 ? std::optional(Rotation{t.rotation_axis, t.rotation_rad})
                                                   : std::nullopt;
                    }),
                rotation.type(), "rotation")
      .with_default("scale", &TransformDocument::scale, either(uniform, by_axis), "1",
                    "factor on all coordinates, or on each");
  return record.type();
}

SchemaType<PresenceDocument> presence_type() {
  using Interval = PresenceDocument::Interval;
  using Pair = std::array<geodesy::UtcTime, 2>;
  const SchemaType<std::vector<Pair>> pairs =
      list(tuple<geodesy::UtcTime, 2>(time_type()), 1, kMostIntervals);
  const auto text = [](const geodesy::UtcTime& time) { return geodesy::format_utc(time); };
  const auto read = [read = pairs.read, text](const DocumentNode& node) {
    PresenceDocument presence{{}, node.key_position()};
    const std::vector<Pair> given = read(node);
    for (std::size_t k = 0; k < given.size(); ++k) {
      const auto& [begin, end] = given[k];
      const DocumentNode& one = node.items()[k];
      if (!(geodesy::seconds_after(end, begin) > 0.0))
        one.fail(
            format("{} ends at {}, which is not after it begins, {}", one.title(), text(end), text(begin)));
      for (const Interval& other : presence.intervals)
        if (geodesy::seconds_after(other.end, begin) > 0.0 && geodesy::seconds_after(end, other.begin) > 0.0)
          one.fail(format("{}, {} to {}, overlaps another interval, {} to {}: join them", one.title(),
                          text(begin), text(end), text(other.begin), text(other.end)));
      presence.intervals.push_back({begin, end});
    }
    std::sort(presence.intervals.begin(), presence.intervals.end(), [](const Interval& a, const Interval& b) {
      return geodesy::seconds_after(b.begin, a.begin) > 0.0;
    });
    return presence;
  };
  return {pairs.description, read, [write = pairs.write](const PresenceDocument& presence, Writing& writing) {
            std::vector<Pair> given;
            for (const Interval& one : presence.intervals) given.push_back({one.begin, one.end});
            return write(given, writing);
          }};
}

void add_keys_of_all(Record<ObjectDocument>& record) {
  record.optional("name", &ObjectDocument::name, label(), "for messages and reports")
      .optional("temperature", &ObjectDocument::temperature, temperature_type(), "instead of the material's")
      .optional("pilot_ray", &ObjectDocument::pilot_ray, boolean(),
                "send a ray at it where it is smaller than a pixel; decided by its shape if not given")
      .formerly("seed")
      .optional(
          "present", shared(&ObjectDocument::present), presence_type(),
          "when it is there: pairs of times, from and until; without it always. The picture shows what is there at the "
          "document's 'time'; temperatures that are solved know what stood there before");
}

void add_common_keys(Record<ObjectDocument>& record) {
  record.optional("transform", &ObjectDocument::transform, transform_type(), "where the shape goes")
      .optional("motion",
                via([](ObjectDocument& object,
                       std::shared_ptr<const PlatformDocument> motion) { object.motion = std::move(motion); },
                    [](const ObjectDocument& object) {
                      return object.motion ? std::optional(object.motion) : std::nullopt;
                    }),
                motion_type(), "the path that it moves along; without it, it stands still");
  add_keys_of_all(record);
}

template <class Shape>
void add_shape(Record<ObjectDocument>& record, const std::string& key, const SchemaType<Shape>& type) {
  using Placed = std::pair<Shape, SourcePosition>;
  const auto placed = located<Placed>(
      type,
      [](Shape shape, const DocumentNode& node) { return Placed(std::move(shape), node.key_position()); },
      [](const Placed& shape) { return shape.first; });
  record.one(key,
             via(
                 [](ObjectDocument& object, Placed shape) {
                   object.shape = std::move(shape.first);
                   object.shape_position = std::move(shape.second);
                 },
                 [](const ObjectDocument& object) {
                   const Shape* shape = std::get_if<Shape>(&object.shape);
                   return shape != nullptr ? std::optional(Placed(*shape, {})) : std::nullopt;
                 }),
             placed, type.description->doc);
}

SchemaType<ObjectDocument> shape_object_type() {
  Record<ObjectDocument> record("object", "A shape with a material.");
  record.exactly_one();
  for (const PrimitiveModel* model : primitive_models())
    add_shape(record, std::string(model->key),
              converted<PrimitiveShape>(
                  model->type(),
                  [model](std::shared_ptr<const PrimitiveSettings> settings) {
                    return PrimitiveShape{std::string(model->key), std::move(settings)};
                  },
                  [](const PrimitiveShape& shape) { return shape.settings; }));
  add_shape(record, "mesh", mesh_type());
  add_shape(record, "city", city_type());
  add_shape(record, "terrain", terrain_type());
  record.required("material", &ObjectDocument::material, binding_type(), "what it is made of");
  add_common_keys(record);
  return record.type();
}

SchemaType<ObjectDocument> instance_object_type() {
  Record<ObjectDocument> record("copies", "Copies of a prototype, whose objects bring their materials.");
  record.exactly_one();
  add_shape(record, "instance", instance_type());
  add_shape(record, "instances", instances_type());
  add_common_keys(record);
  return record.type();
}

SchemaType<ObjectDocument> random_copies_type() {
  Record<ObjectDocument> record("random copies", "Copies of prototypes at random places of the scene.");
  record.exactly_one();
  add_shape(record, "random_placement", random_placement_type());
  record.formerly("scatter");
  add_keys_of_all(record);
  return record.type();
}

}  // namespace

SchemaType<std::vector<ObjectDocument>> objects_type() {
  const SchemaType<ObjectDocument> shape = shape_object_type();
  const int without_tag = 2;
  const auto any = tagged<ObjectDocument>({{{"instance", "instances"}, instance_object_type()},
                                           {{"random_placement"}, random_copies_type()},
                                           {{}, shape}},
                                          without_tag);
  return list(any, 1, kMostObjects);
}

}  // namespace ifov::io
