#include "io/products/acquisition_json.h"

namespace ifov::io {
namespace {

template <class Vector>
Json::Value list(const Vector& v) {
  Json::Value result = Json::arrayValue;
  for (const double part : {v.x, v.y, v.z}) result.append(part);
  return result;
}

template <class Vector>
Vector vector_of(const Json::Value& v) {
  return {v[0].asDouble(), v[1].asDouble(), v[2].asDouble()};
}

void put(Json::Value& v, const Acquisition::Place& place) {
  v["latitude_deg"] = place.latitude_deg;
  v["longitude_deg"] = place.longitude_deg;
}

std::optional<Acquisition::Place> place_of(const Json::Value& v) {
  if (!v.isMember("latitude_deg")) return std::nullopt;
  return Acquisition::Place{v["latitude_deg"].asDouble(), v["longitude_deg"].asDouble()};
}

Json::Value camera_value(const Acquisition::Camera& camera) {
  Json::Value v;
  v["model"] = camera.is_frame ? "frame" : "orthographic";
  v["right"] = list(camera.right);
  v["down"] = list(camera.down);
  v["forward"] = list(camera.forward);
  if (camera.ground_sample_m > 0.0) v["ground_sample_m"] = camera.ground_sample_m;
  if (!camera.is_frame) return v;
  v["position_m"] = list(camera.position_m);
  v["focal_length_m"] = camera.focal_length_m;
  v["pitch_m"] = camera.pitch_m;
  return v;
}

Acquisition::Camera camera_of(const Json::Value& v) {
  Acquisition::Camera camera;
  camera.is_frame = v["model"].asString() == "frame";
  camera.right = vector_of<math::Vec3>(v["right"]);
  camera.down = vector_of<math::Vec3>(v["down"]);
  camera.forward = vector_of<math::Vec3>(v["forward"]);
  camera.ground_sample_m = v.get("ground_sample_m", 0.0).asDouble();
  if (!camera.is_frame) return camera;
  camera.position_m = vector_of<math::Point3>(v["position_m"]);
  camera.focal_length_m = v["focal_length_m"].asDouble();
  camera.pitch_m = v["pitch_m"].asDouble();
  return camera;
}

}  // namespace

Json::Value to_value(const Acquisition& a) {
  Json::Value v;
  if (!a.time.empty()) v["time"] = a.time;
  if (a.light) {
    Json::Value& light = v[a.light->is_moon ? "moon" : "sun"];
    light["zenith_deg"] = a.light->zenith_deg;
    light["azimuth_deg"] = a.light->azimuth_deg;
  }
  if (a.origin) put(v["origin"], *a.origin);
  v["origin"]["height_m"] = a.origin_height_m;
  v["origin"]["map_m"] = list(a.origin_on_map_m);
  v["camera"] = camera_value(a.camera);
  v["footprint"] = Json::arrayValue;
  for (const auto& corner : a.footprint) {
    Json::Value c;
    if (corner) {
      c["map_m"] = list(corner->position_m);
      if (corner->place) put(c, *corner->place);
    }
    v["footprint"].append(c);
  }
  return v;
}

Acquisition acquisition_of(const Json::Value& v) {
  Acquisition a;
  a.time = v.get("time", "").asString();
  for (const char* const name : {"sun", "moon"})
    if (v.isMember(name))
      a.light = {v[name]["zenith_deg"].asDouble(), v[name]["azimuth_deg"].asDouble(), name[0] == 'm'};
  a.origin = place_of(v["origin"]);
  a.origin_height_m = v["origin"]["height_m"].asDouble();
  a.origin_on_map_m = vector_of<math::Point3>(v["origin"]["map_m"]);
  a.camera = camera_of(v["camera"]);
  for (const Json::Value& c : v["footprint"]) {
    a.footprint.emplace_back();
    if (!c.isNull()) a.footprint.back() = {vector_of<math::Point3>(c["map_m"]), place_of(c)};
  }
  return a;
}

}  // namespace ifov::io
