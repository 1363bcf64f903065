#include <json/json.h>

#include <algorithm>

#include "core/error.h"
#include "io/files/own_files.h"
#include "io/products/acquisition_json.h"
#include "io/products/sha256.h"
#include "io/run_state/run_plan.h"

namespace ifov::io {
namespace {

constexpr int kFormat = 3;

Json::Value count(std::uint64_t value) { return Json::Value(static_cast<Json::UInt64>(value)); }

std::string hex(std::uint64_t value) { return format("{:016x}", value); }
std::uint64_t from_hex(const std::string& text) { return std::stoull(text, nullptr, 16); }

std::string text_of(const Json::Value& value, const char* indentation) {
  Json::StreamWriterBuilder writer;
  writer["indentation"] = indentation;
  writer["emitUTF8"] = true;
  writer["precision"] = 17;
  return Json::writeString(writer, value);
}

std::string checksum_of(const Json::Value& state) {
  const std::string text = text_of(state, "");
  Sha256 sum;
  sum.update(text.data(), text.size());
  return sum.digest();
}

constexpr std::pair<const char*, double render::AirHalfWidth::*> kAirKeys[] = {
    {"path", &render::AirHalfWidth::path},
    {"surface", &render::AirHalfWidth::surface},
    {"sky", &render::AirHalfWidth::sky},
    {"path_radiance", &render::AirHalfWidth::path_radiance},
    {"white_in_sky", &render::AirHalfWidth::white_in_sky},
    {"nodes_path", &render::AirHalfWidth::nodes_path},
    {"nodes_surface", &render::AirHalfWidth::nodes_surface},
    {"nodes_sky", &render::AirHalfWidth::nodes_sky},
    {"grey_radiance", &render::AirHalfWidth::grey_radiance}};

Json::Value image_value(const render::ImageInfo& image) {
  Json::Value v;
  v["width_px"] = image.width_px;
  v["height_px"] = image.height_px;
  v["radiance_unit"] = image.radiance_unit;
  v["footprint_px"] = image.footprint_px;
  v["channels"] = Json::arrayValue;
  for (const auto& channel : image.channels) {
    Json::Value c;
    c["name"] = channel.name;
    c["centre_um"] = channel.centre_um;
    c["fwhm_um"] = channel.fwhm_um;
    if (channel.air)
      for (const auto& [key, member] : kAirKeys) c["air"][key] = (*channel.air).*member;
    v["channels"].append(c);
  }
  v["materials"] = Json::arrayValue;
  for (const auto& name : image.materials) v["materials"].append(name);
  if (image.has_map) {
    v["map"]["x_m"] = image.map_x_m;
    v["map"]["y_m"] = image.map_y_m;
    v["map"]["gsd_m"] = image.gsd_m;
    v["map"]["rotation_rad"] = image.map_rotation_rad;
  }
  v["map_system"] = image.map_projection;
  return v;
}

render::ImageInfo image_of(const Json::Value& v) {
  render::ImageInfo image;
  image.width_px = v["width_px"].asInt();
  image.height_px = v["height_px"].asInt();
  image.radiance_unit = v["radiance_unit"].asString();
  image.footprint_px = v["footprint_px"].asDouble();
  for (const Json::Value& c : v["channels"]) {
    image.channels.push_back({c["name"].asString(), c["centre_um"].asDouble(), c["fwhm_um"].asDouble()});
    if (!c.isMember("air")) continue;
    render::AirHalfWidth& air = image.channels.back().air.emplace();
    for (const auto& [key, member] : kAirKeys) air.*member = c["air"][key].asDouble();
  }
  for (const Json::Value& name : v["materials"]) image.materials.push_back(name.asString());
  if (v.isMember("map")) {
    const Json::Value& map = v["map"];
    image.has_map = true;
    image.map_x_m = map["x_m"].asDouble();
    image.map_y_m = map["y_m"].asDouble();
    image.gsd_m = map["gsd_m"].asDouble();
    image.map_rotation_rad = map["rotation_rad"].asDouble();
  }
  image.map_projection = v["map_system"].asString();
  return image;
}

Json::Value state_value(const RunPlan& plan) {
  Json::Value v;
  const RunIdentity& identity = plan.identity;
  v["program"]["version"] = identity.version;
  v["program"]["build"] = plan.build;
  v["instruction_set"] = plan.instruction_set;
  v["document"]["path"] = identity.document_path;
  v["document"]["text"] = identity.document_text;
  v["seed"] = count(identity.seed);
  v["sampler"] = identity.sampler;
  v["accuracy"]["asked"] = identity.accuracy_asked;
  v["accuracy"]["confidence"] = identity.confidence;
  v["accuracy"]["judged"] = plan.judged;
  v["accuracy"]["knows_errors"] = plan.knows_errors;
  v["accuracy"]["error"] = plan.error;
  v["accuracy"]["unit"] = plan.error_unit;
  v["refining"]["keeps_memory"] = plan.keeps_memory;
  v["refining"]["base"] = hex(plan.base);
  v["refining"]["from"] = Json::arrayValue;
  for (const std::string& accuracy : plan.refined_from) v["refining"]["from"].append(accuracy);
  v["tile_px"] = plan.tile_px;
  v["share"]["number"] = plan.share.number;
  v["share"]["count"] = plan.share.count;
  v["image"] = image_value(plan.image);
  v["files"] = Json::arrayValue;
  for (const FileStamp& file : plan.files) {
    Json::Value f;
    f["path"] = file.path;
    f["bytes"] = count(file.bytes);
    f["time_ns"] = static_cast<Json::Int64>(file.time_ns);
    f["xxh3_128"] = hex(file.hash[1]) + hex(file.hash[0]);
    v["files"].append(f);
  }
  v["notes"] = Json::arrayValue;
  for (const std::string& note : plan.notes) v["notes"].append(note);
  v["acquisition"] = to_value(identity.acquisition);
  v["products"]["name"] = plan.name;
  v["products"]["cubes"] = Json::arrayValue;
  for (std::size_t k = 0; k < kProductCount; ++k)
    if (plan.cubes.has(static_cast<Product>(k))) v["products"]["cubes"].append(std::string(kProductNames[k]));
  v["products"]["geotiff"] = plan.geotiff;
  v["products"]["netcdf"] = plan.netcdf;
  v["products"]["quicklook"] = plan.quicklook;
  v["products"]["report"] = plan.report;
  v["products"]["quicklook_channels"] = Json::arrayValue;
  for (const int channel : plan.quicklook_channels) v["products"]["quicklook_channels"].append(channel);
  return v;
}

RunPlan plan_of(const Json::Value& v) {
  RunPlan plan;
  plan.identity = {v["program"]["version"].asString(),
                   v["document"]["path"].asString(),
                   v["document"]["text"].asString(),
                   v["seed"].asUInt64(),
                   v["sampler"].asString(),
                   v["accuracy"]["asked"].asString(),
                   v["accuracy"]["confidence"].asDouble(),
                   acquisition_of(v["acquisition"])};
  plan.build = v["program"]["build"].asString();
  plan.instruction_set = v["instruction_set"].asString();
  plan.judged = v["accuracy"]["judged"].asBool();
  plan.knows_errors = v["accuracy"]["knows_errors"].asBool();
  plan.error = v["accuracy"]["error"].asDouble();
  plan.error_unit = v["accuracy"]["unit"].asString();
  plan.keeps_memory = v["refining"]["keeps_memory"].asBool();
  plan.base = from_hex(v["refining"]["base"].asString());
  for (const Json::Value& accuracy : v["refining"]["from"]) plan.refined_from.push_back(accuracy.asString());
  plan.tile_px = v["tile_px"].asInt();
  plan.share = {v["share"]["number"].asInt(), v["share"]["count"].asInt()};
  plan.image = image_of(v["image"]);
  for (const Json::Value& f : v["files"]) {
    const std::string hash = f["xxh3_128"].asString();
    plan.files.push_back({f["path"].asString(),
                          f["bytes"].asUInt64(),
                          f["time_ns"].asInt64(),
                          {from_hex(hash.substr(16)), from_hex(hash.substr(0, 16))}});
  }
  for (const Json::Value& note : v["notes"]) plan.notes.push_back(note.asString());
  plan.name = v["products"]["name"].asString();
  plan.cubes = {};
  for (const Json::Value& name : v["products"]["cubes"]) {
    const auto found = std::find(kProductNames.begin(), kProductNames.end(), name.asString());
    if (found != kProductNames.end()) plan.cubes.add(static_cast<Product>(found - kProductNames.begin()));
  }
  plan.geotiff = v["products"]["geotiff"].asBool();
  plan.netcdf = v["products"]["netcdf"].asBool();
  plan.quicklook = v["products"]["quicklook"].asBool();
  plan.report = v["products"]["report"].asBool();
  for (const Json::Value& channel : v["products"]["quicklook_channels"])
    plan.quicklook_channels.push_back(channel.asInt());
  return plan;
}

bool is_sound(const RunPlan& plan) {
  return plan.image.width_px > 0 && plan.image.height_px > 0 && plan.tile_px > 0 &&
         !plan.image.channels.empty() && plan.share.count > 0 && plan.share.number > 0 &&
         plan.share.number <= plan.share.count;
}

}  // namespace

std::string to_json(const RunPlan& plan) {
  Json::Value root;
  root["format"] = kFormat;
  root["state"] = state_value(plan);
  root["sha256"] = checksum_of(root["state"]);
  return text_of(root, "  ") + "\n";
}

RunPlan plan_in(const std::string& text, const std::string& name) {
  const EnvironmentError damaged(
      format("{}: it is damaged; what it belongs to cannot be known, so its tiles cannot be "
             "used: start anew with --restart",
             name));
  try {
    Json::CharReaderBuilder builder;
    Json::CharReaderBuilder::strictMode(&builder.settings_);
    const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
    Json::Value root;
    std::string errors;
    if (!reader->parse(text.data(), text.data() + text.size(), &root, &errors) || !root.isObject())
      throw damaged;
    if (root["format"].isInt() && root["format"].asInt() != kFormat)
      throw EnvironmentError(
          format("{}: it is of format {}, this program reads format {}: go on with the program that "
                 "wrote it, or start anew with --restart",
                 name, root["format"].asInt(), kFormat));
    if (!root["sha256"].isString() || root["sha256"].asString() != checksum_of(root["state"])) throw damaged;
    const RunPlan plan = plan_of(root["state"]);
    if (!is_sound(plan)) throw damaged;
    return plan;
  } catch (const Json::Exception&) {
    throw damaged;
  } catch (const std::logic_error&) {  // a hash that is no number
    throw damaged;
  }
}

RunPlan read_plan(const std::filesystem::path& file) {
  refuse_link(file.parent_path());
  return plan_in(read_own_file(file), file.string());
}

}  // namespace ifov::io
