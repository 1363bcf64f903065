#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/error.h"
#include "core/parallel.h"
#include "io/json/json_writer.h"
#include "viewer/answers/answers.h"
#include "viewer/sources/checked_document.h"
#include "viewer/sources/scene_source.h"

namespace ifov::viewer {
namespace {

using io::JsonWriter;
using session::SceneModel;
using session::SensorSketch;
using session::SurfacePaint;

constexpr int kMostAcross = 8192;           // pixels of a picture along a side
constexpr std::size_t kMostRays = 1 << 17;  // of one answer
constexpr std::size_t kBatch = 512;         // rays between two looks at whether anybody waits for them
constexpr double kFarthest_m = 1e8;         // of the eye from the origin
constexpr std::array<std::string_view, 3> kPaints{"reflectance", "material", "object"};

SurfacePaint paint_of(const Query& query) {
  const std::string name = query.choice("paint", kPaints);
  return name == "reflectance" ? SurfacePaint::reflectance
         : name == "material"  ? SurfacePaint::material
                               : SurfacePaint::object;
}

/// A pinhole whose axis goes to an azimuth (clockwise from north) and an elevation, top up.
class Eye {
 public:
  explicit Eye(const Query& query)
      : at_{query.number("x", -kFarthest_m, kFarthest_m), query.number("y", -kFarthest_m, kFarthest_m),
            query.number("z", -kFarthest_m, kFarthest_m)},
        width_px_(query.integer("width", 1, kMostAcross)),
        height_px_(query.integer("height", 1, kMostAcross)) {
    constexpr double kRad = std::numbers::pi / 180.0;
    const double azimuth = kRad * query.number("azimuth", -360.0, 360.0),
                 elevation = kRad * query.number("elevation", -90.0, 90.0);
    tangent_ = std::tan(0.5 * kRad * query.number("fov", 0.001, 150.0));
    const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation),
                 se = std::sin(elevation);
    forward_ = {sa * ce, ca * ce, se};
    right_ = {ca, -sa, 0.0};
    up_ = {-sa * se, -ca * se, ce};
  }

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

  /// `fov` is that of the height.
  math::Ray ray(double x_px, double y_px) const {
    const double scale = 2.0 * tangent_ / height_px_;
    const math::Vec3 towards =
        forward_ + right_ * (scale * (x_px - 0.5 * width_px_)) + up_ * (scale * (0.5 * height_px_ - y_px));
    return {.origin_m = at_, .direction = math::normalized(towards)};
  }

 private:
  math::Point3 at_;
  int width_px_, height_px_;
  double tangent_ = 1.0;
  math::Vec3 forward_, right_, up_;
};

void put(JsonWriter& json, const char* name, const math::Point3& p) {
  json.member(name, std::vector<double>{p.x, p.y, p.z});
}

void put(JsonWriter& json, const char* name, const std::vector<SensorSketch::Sight>& sights) {
  json.list(name, [&] {
    for (const SensorSketch::Sight& sight : sights)
      json.object([&] {
        put(json, "from", sight.from_m);
        json.member("direction",
                    std::vector<double>{sight.direction.x, sight.direction.y, sight.direction.z});
        if (sight.to_m) put(json, "to", *sight.to_m);
      });
  });
}

void put_sensor(JsonWriter& json, const SensorSketch& sensor) {
  json.object("sensor", [&] {
    json.member("kind", sensor.kind);
    json.member("width", sensor.width_px);
    json.member("height", sensor.height_px);
    json.member("parallel", sensor.is_parallel);
    json.member("duration", sensor.duration_s);
    json.member("count", sensor.view_count);
    put(json, "axis", {sensor.axis});
    put(json, "corners", sensor.corners);
    put(json, "views", sensor.views);
    // Numbers in a row: nothing of an outline, where a ray meets nothing, is no number.
    std::vector<double> track, outline;
    for (const math::Point3& p : sensor.track_m) track.insert(track.end(), {p.x, p.y, p.z});
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (const auto& p : sensor.outline_m)
      outline.insert(outline.end(), {p ? p->x : kNone, p ? p->y : kNone, p ? p->z : kNone});
    json.member("track", track);
    json.member("outline", outline);
  });
}

void put_model(JsonWriter& json, const SceneModel& model) {
  json.member("statement", model.statement());
  json.member("paint", kPaints[static_cast<std::size_t>(model.usual_paint())]);
  const math::Vec3 offset = model.offset_m();
  json.member("offset", std::vector<double>{offset.x, offset.y, offset.z});
  if (const auto box = model.bounds_m()) {
    put(json, "low", (*box)[0]);
    put(json, "high", (*box)[1]);
  }
  if (const auto& sun = model.sun()) json.member("sun", std::vector<double>{sun->x, sun->y, sun->z});
  if (const auto& sensor = model.sensor()) put_sensor(json, *sensor);
}

}  // namespace

SceneSource& Answers::scene_source() {
  if (!scene_) throw Refused(404, "no document is shown, whose scene could be");
  return *scene_;
}

std::shared_ptr<const SceneModel> Answers::scene_model() {
  const SceneSource::State state = scene_source().state();
  if (!state.model) throw Refused(409, state.failure.empty() ? "the scene is being loaded" : state.failure);
  return state.model;
}

Answer Answers::scene(const Query&) {
  document_version();
  const SceneSource::State state = scene_source().state();
  // Once it is there the checks are worked out, too, before they are looked at.
  if (document_ != nullptr && (state.model || !state.failure.empty())) document_->begin();
  JsonWriter json(JsonWriter::Layout::compact);
  json.object([&] {
    json.member("version", state.version);
    json.member("state", state.model ? "ready" : state.failure.empty() ? "loading" : "failed");
    json.member("failure", state.failure);
    json.member("file", scene_source().file());
    json.member("phase", state.phase);
    json.member("done", state.done);
    json.member("of", state.of);
    json.member("elapsed", state.elapsed_s);
    json.member("rays", scene_source().rays.load());
    json.list("faults", [&] {
      for (const session::DocumentFault& fault : state.model ? state.model->faults() : state.faults)
        json.object([&] {
          json.member("text", fault.text);
          json.member("file", fault.position.file);
          json.member("line", fault.position.line);
          json.member("instead", fault.instead);
        });
    });
    if (state.model) put_model(json, *state.model);
  });
  return {.body = json.written()};
}

/// Of every `step`-th pixel of every `step`-th line of a part of a picture three numbers: distance in metres (none where nothing is
/// met), colour (0xRRGGBB) and object (-1: none of the document's).
Answer Answers::look(const Query& query) {
  const auto model = scene_model();
  const Eye eye(query);
  const SurfacePaint paint = paint_of(query);
  const int x0 = query.integer("x0", 0, eye.width_px() - 1), y0 = query.integer("y0", 0, eye.height_px() - 1);
  const int x1 = query.integer("x1", x0 + 1, eye.width_px()),
            y1 = query.integer("y1", y0 + 1, eye.height_px());
  const int step = query.integer("step", 1, kMostAcross);
  const auto apart = static_cast<std::size_t>(step), width = static_cast<std::size_t>(x1 - x0),
             height = static_cast<std::size_t>(y1 - y0);
  const std::size_t columns = (width + apart - 1) / apart, rows = (height + apart - 1) / apart,
                    count = columns * rows;
  if (count > kMostRays)
    throw Refused(400, format("{} x {} rays are asked for; expected {} at most: take fewer lines", columns,
                              rows, kMostRays));
  // One picture at a time has all cores; who has gone meanwhile leaves the queue.
  while (!rays_.try_acquire_for(std::chrono::milliseconds(20)))
    if (query.nobody_waits()) throw Refused(408, "nobody waits for the answer");
  const Turn turn(rays_);
  std::vector<float> values(3 * count);
  // An exception would cancel what is made within the loop as well, the trees of large meshes among it.
  std::atomic<bool> over{false};
  parallel_for(static_cast<std::int64_t>((count + kBatch - 1) / kBatch), 0, [&](std::int64_t batch) {
    if (over) return;
    if (query.nobody_waits()) {
      over = true;
      return;
    }
    const std::size_t first = static_cast<std::size_t>(batch) * kBatch, end = std::min(first + kBatch, count);
    std::vector<math::Ray> rays;
    for (std::size_t k = first; k < end; ++k)
      rays.push_back(eye.ray(x0 + 0.5 + static_cast<double>(thinned_place(k % columns, apart, width)),
                             y0 + 0.5 + static_cast<double>(thinned_place(k / columns, apart, height))));
    std::vector<SceneModel::Seen> seen(rays.size());
    model->look(rays, paint, seen);
    scene_->rays += static_cast<std::int64_t>(rays.size());
    for (std::size_t k = first; k < end; ++k) {
      const SceneModel::Seen& one = seen[k - first];
      values[3 * k] = one.distance_m;
      values[3 * k + 1] = static_cast<float>(one.colour);
      values[3 * k + 2] = static_cast<float>(one.object);
    }
  });
  if (over) throw Refused(408, "nobody waits for the answer");
  return numbers(values, format("{{\"columns\":{},\"rows\":{}}}", columns, rows));
}

/// What a point of a picture shows: object, materials, place.
Answer Answers::pick(const Query& query) {
  const auto model = scene_model();
  const Eye eye(query);
  const auto picked =
      model->pick(eye.ray(query.number("u", 0.0, eye.width_px()), query.number("v", 0.0, eye.height_px())));
  ++scene_->rays;
  JsonWriter json(JsonWriter::Layout::compact);
  json.object([&] {
    json.member("hit", picked.has_value());
    if (!picked) return;
    const math::Vec3 offset = model->offset_m();
    put(json, "scene", picked->position_m);
    put(json, "position", picked->position_m + offset);
    json.member("normal", std::vector<double>{picked->normal.x, picked->normal.y, picked->normal.z});
    json.member("distance", picked->distance_m);
    json.member("object", picked->object);
    json.member("name", picked->name);
    json.member("line", picked->line);
    json.member("file", picked->file);
    json.list("materials", [&] {
      for (const auto& share : picked->materials)
        json.object([&] {
          json.member("name", share.material);
          json.member("share", share.weight);
        });
    });
  });
  return {.body = json.written()};
}

}  // namespace ifov::viewer
