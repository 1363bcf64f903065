#include "io/products/run_json.h"

#include <json/json.h>

#include <cmath>

#include "io/products/acquisition_json.h"
#include "io/products/map_info.h"

namespace ifov::io {
namespace {

Json::Value number(double value) { return std::isfinite(value) ? Json::Value(value) : Json::Value(); }
Json::Value count(std::uint64_t value) { return Json::Value(static_cast<Json::UInt64>(value)); }

Json::Value system_value(const render::ImageInfo& info) {
  const MapSystem system = map_system(info);
  Json::Value v;
  v["name"] = system.name;
  v["epsg"] = system.epsg > 0 ? Json::Value(system.epsg) : Json::Value();
  v["wkt"] = system.wkt;
  return v;
}

Json::Value image(const render::ImageInfo& info) {
  Json::Value v;
  v["width_px"] = info.width_px;
  v["height_px"] = info.height_px;
  v["radiance_unit"] = info.radiance_unit;
  v["footprint_px"] = number(info.footprint_px);
  if (info.has_map) {
    v["map"]["upper_left_x_m"] = info.map_x_m;
    v["map"]["upper_left_y_m"] = info.map_y_m;
    v["map"]["gsd_m"] = info.gsd_m;
    v["map"]["rotation_rad"] = info.map_rotation_rad;
  }
  if (!info.map_projection.empty() && info.map_projection != "Arbitrary") v["map"]["system"] = system_value(info);
  v["materials"] = Json::arrayValue;
  for (const auto& name : info.materials) v["materials"].append(name);
  return v;
}

Json::Value channels(const RunRecord& record) {
  Json::Value list = Json::arrayValue;
  for (std::size_t c = 0; c < record.image.channels.size(); ++c) {
    const auto& channel = record.image.channels[c];
    const auto& s = record.statistics.channels.at(c);
    Json::Value v;
    v["name"] = channel.name;
    v["centre_um"] = number(channel.centre_um);
    v["fwhm_um"] = number(channel.fwhm_um);
    v["minimum"] = number(s.minimum);
    v["maximum"] = number(s.maximum);
    v["mean"] = number(s.mean);
    v["standard_deviation"] = number(s.standard_deviation);
    v["mean_half_width"] = number(s.mean_half_width);
    v["largest_half_width"] = number(s.largest_half_width);
    if (s.parts) {
      v["mean_half_width_parts"]["sampling"] = number(s.parts->sampling);
      v["mean_half_width_parts"]["air"] = number(s.parts->air);
      v["mean_half_width_parts"]["nodes"] = number(s.parts->nodes);
    }
    if (channel.air) {
      v["air_half_width"]["path"] = number(channel.air->path);
      v["air_half_width"]["surface"] = number(channel.air->surface);
      v["air_half_width"]["sky"] = number(channel.air->sky);
      v["air_half_width"]["path_radiance"] = number(channel.air->path_radiance);
      v["air_half_width"]["white_in_sky"] = number(channel.air->white_in_sky);
      v["air_half_width"]["nodes"]["path"] = number(channel.air->nodes_path);
      v["air_half_width"]["nodes"]["surface"] = number(channel.air->nodes_surface);
      v["air_half_width"]["nodes"]["sky"] = number(channel.air->nodes_sky);
      v["air_half_width"]["of_grey_surface"] = number(channel.air->of(channel.air->grey_radiance));
    }
    v["not_finite"] = count(s.not_finite);
    list.append(v);
  }
  return list;
}

Json::Value cost(const RunRecord& record) {
  const auto& s = record.statistics;
  Json::Value v;
  v["elapsed_s"] = number(record.outcome.elapsed_s);
  v["threads"] = record.outcome.threads;
  v["samples"]["total"] = count(s.samples);
  v["samples"]["fewest_in_a_pixel"] = s.fewest_samples;
  v["samples"]["most_in_a_pixel"] = s.most_samples;
  v["samples"]["label_rays"] = count(s.label_rays);
  v["samples"]["radiance_evaluations"] = count(s.radiance_evaluations);
  v["samples"]["seeds"] = count(s.seed_samples);
  v["samples"]["probes"] = count(s.probe_samples);
  v["samples"]["halo"] = count(s.halo_samples);
  v["rays"]["primary"] = count(s.rays.primary);
  v["rays"]["shadow"] = count(s.rays.shadow);
  v["rays"]["bounce"] = count(s.rays.bounce);
  v["rays"]["total"] = count(s.rays.total());
  return v;
}

Json::Value accuracy(const RunRecord& record) {
  const auto& s = record.statistics;
  Json::Value v;
  v["asked"] = record.identity.accuracy_asked;
  v["confidence"] = number(record.identity.confidence);
  v["reached"] = record.outcome.accuracy_statement;
  v["detection"] = record.outcome.detection_statement;
  v["pixels"] = count(s.pixels);
  v["pixels_converged"] = count(s.converged);
  v["pixels_by_reason"] = Json::objectValue;
  for (std::size_t r = 0; r < s.reasons.size(); ++r)
    v["pixels_by_reason"][std::string(sampling::kReasonNames[r])] = count(s.reasons[r]);
  v["worst_ratio"] = number(s.worst_ratio);
  v["largest_missable_fraction"] = number(s.largest_missable_fraction);
  return v;
}

}  // namespace

std::string to_json(const RunRecord& record) {
  Json::Value root;
  root["program"]["name"] = "ifov";
  root["program"]["version"] = record.identity.version;
  root["document"]["path"] = record.identity.document_path;
  root["document"]["text"] = record.identity.document_text;
  root["seed"] = count(record.identity.seed);
  root["sampler"] = record.identity.sampler;
  root["accuracy"] = accuracy(record);
  root["date"] = record.outcome.date;
  root["acquisition"] = to_value(record.identity.acquisition);
  root["image"] = image(record.image);
  root["channels"] = channels(record);
  root["cost"] = cost(record);
  root["notes"] = Json::arrayValue;
  for (const auto& note : record.outcome.notes) root["notes"].append(note);
  root["files"] = Json::arrayValue;
  for (const auto& file : record.files) {
    Json::Value v;
    v["name"] = file.path.filename().string();
    v["what"] = file.what;
    v["bytes"] = count(file.bytes);
    v["sha256"] = file.sha256;
    root["files"].append(v);
  }
  Json::StreamWriterBuilder writer;
  writer["indentation"] = "  ";
  writer["emitUTF8"] = true;
  writer["precision"] = 9;
  return Json::writeString(writer, root) + "\n";
}

}  // namespace ifov::io
