#include "io/product_parts/acquisition_json.h"

#include <array>

namespace ifov::io {
namespace {

std::array<double, 3> list(const auto& v) { return {v.x, v.y, v.z}; }

template <class Vector>
Vector vector_of(const JsonView& view) {
  const std::vector<JsonView> parts = view.items();
  if (parts.size() != 3) return {};
  return {parts[0].number(), parts[1].number(), parts[2].number()};
}

void write_members(JsonWriter& json, const Acquisition::Position& position) {
  json.member("latitude_deg", position.latitude_deg);
  json.member("longitude_deg", position.longitude_deg);
}

std::optional<Acquisition::Position> position_of(const JsonView& view) {
  if (!view["latitude_deg"].is_there()) return std::nullopt;
  return Acquisition::Position{view["latitude_deg"].number(), view["longitude_deg"].number()};
}

Acquisition::Pose pose_of(const JsonView& view) {
  return {vector_of<math::Point3>(view["position_m"]), vector_of<math::Vec3>(view["right"]),
          vector_of<math::Vec3>(view["down"]), vector_of<math::Vec3>(view["forward"])};
}

void write_members(JsonWriter& json, const Acquisition::Camera& camera) {
  json.member("down", list(camera.down));
  if (camera.focal_length_m > 0.0) json.member("focal_length_m", camera.focal_length_m);
  json.member("forward", list(camera.forward));
  if (camera.ground_sample_m > 0.0) json.member("ground_sample_m", camera.ground_sample_m);
  if (!camera.lines.empty())
    json.list("lines", [&] {
      for (const Acquisition::Line& line : camera.lines)
        json.object([&] {
          json.member("down", list(line.pose.down));
          json.member("forward", list(line.pose.forward));
          json.member("line", line.line);
          json.member("position_m", list(line.pose.position_m));
          json.member("right", list(line.pose.right));
          json.member("time_s", line.time_s);
          if (!line.truth) return;
          json.object("true", [&] {
            json.member("down", list(line.truth->down));
            json.member("forward", list(line.truth->forward));
            json.member("position_m", list(line.truth->position_m));
            json.member("right", list(line.truth->right));
          });
        });
    });
  json.member("model", camera.model);
  if (camera.pitch_m > 0.0) json.member("pitch_m", camera.pitch_m);
  if (camera.position_m) json.member("position_m", list(*camera.position_m));
  json.member("right", list(camera.right));
}

Acquisition::Camera camera_of(const JsonView& view) {
  Acquisition::Camera camera;
  camera.model = view["model"].text();
  camera.right = vector_of<math::Vec3>(view["right"]);
  camera.down = vector_of<math::Vec3>(view["down"]);
  camera.forward = vector_of<math::Vec3>(view["forward"]);
  camera.ground_sample_m = view["ground_sample_m"].number();
  if (view["position_m"].is_there()) camera.position_m = vector_of<math::Point3>(view["position_m"]);
  if (view["focal_length_m"].is_there()) camera.focal_length_m = view["focal_length_m"].number();
  if (view["pitch_m"].is_there()) camera.pitch_m = view["pitch_m"].number();
  for (const JsonView& line : view["lines"].items())
    camera.lines.push_back({line["line"].number(), line["time_s"].number(), pose_of(line),
                            line["true"].is_there() ? std::optional(pose_of(line["true"])) : std::nullopt});
  return camera;
}

}  // namespace

void write_members(JsonWriter& json, const Acquisition& a) {
  json.object("camera", [&] { write_members(json, a.camera); });
  json.list("footprint", [&] {
    for (const auto& corner : a.footprint) {
      if (!corner) {
        json.null();
        continue;
      }
      json.object([&] {
        if (corner->position) write_members(json, *corner->position);
        json.member("map_m", list(corner->position_m));
      });
    }
  });
  const auto light = [&] {
    json.object(a.light->is_moon ? "moon" : "sun", [&] {
      json.member("azimuth_deg", a.light->azimuth_deg);
      json.member("zenith_deg", a.light->zenith_deg);
    });
  };
  if (a.light && a.light->is_moon) light();
  json.object("origin", [&] {
    json.member("height_m", a.origin_height_m);
    if (a.origin) write_members(json, *a.origin);
    json.member("map_m", list(a.origin_on_map_m));
  });
  if (a.light && !a.light->is_moon) light();
  if (!a.time.empty()) json.member("time", a.time);
}

Acquisition acquisition_of(const JsonView& view) {
  Acquisition a;
  a.time = view["time"].text("");
  for (const char* const name : {"sun", "moon"})
    if (view[name].is_there())
      a.light = {view[name]["zenith_deg"].number(), view[name]["azimuth_deg"].number(), name[0] == 'm'};
  a.origin = position_of(view["origin"]);
  a.origin_height_m = view["origin"]["height_m"].number();
  a.origin_on_map_m = vector_of<math::Point3>(view["origin"]["map_m"]);
  a.camera = camera_of(view["camera"]);
  for (const JsonView& corner : view["footprint"].items()) {
    a.footprint.emplace_back();
    if (corner.is_there())
      a.footprint.back() = {vector_of<math::Point3>(corner["map_m"]), position_of(corner)};
  }
  return a;
}

}  // namespace ifov::io
