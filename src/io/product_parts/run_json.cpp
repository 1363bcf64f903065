#include "io/product_parts/run_json.h"

#include <map>

#include "io/json/json_writer.h"
#include "io/product_parts/acquisition_json.h"
#include "io/product_parts/map_info.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/mosaic.h"

namespace ifov::io {
namespace {

// Keys stand in alphabetical order.

void write_accuracy(JsonWriter& json, const RunRecord& record) {
  const auto& s = record.statistics;
  json.member("asked", record.identity.accuracy_asked);
  json.member("confidence", record.identity.confidence);
  json.member("detection", record.outcome.detection_statement);
  if (!record.outcome.image_errors.empty())
    json.list("image", [&] {
      for (const ImageError& error : record.outcome.image_errors)
        json.object([&] {
          json.member("audited", error.audited);
          json.member("limit", error.limit);
          json.member("mean", error.mean);
          json.member("rms", error.reached);
        });
    });
  json.member("largest_missable_fraction", s.largest_missable_fraction);
  json.member("pixels", s.pixels);
  json.object("pixels_by_reason", [&] {
    std::map<std::string_view, std::uint64_t> counts;
    for (std::size_t r = 0; r < s.reasons.size(); ++r) counts[sampling::kReasonNames[r]] = s.reasons[r];
    for (const auto& [name, pixels] : counts) json.member(name, pixels);
  });
  json.member("pixels_converged", s.converged);
  json.member("reached", record.outcome.accuracy_statement);
  json.member("worst_ratio", s.worst_ratio);
}

void write_air(JsonWriter& json, const render::AtmosphereHalfWidth& air) {
  json.object("model", [&] {
    json.member("emission", air.model_emission);
    if (air.model_counted > 0.0) {
      json.member("found_with_bands_alone", air.model_of_bands > 0.0);
      json.member("under_clouds", air.model_under_clouds > 0.0);
    }
    json.member("in_interval", air.model_counted > 0.0);
    json.member("of_grey_surface", air.of_model(air.grey_radiance));
    json.member("path", air.model_path);
    json.member("sky", air.model_sky);
    json.member("sunlight", air.model_sunlight);
    json.member("surface", air.model_surface);
  });
  json.object("nodes", [&] {
    json.member("path", air.nodes_path);
    json.member("sky", air.nodes_sky);
    json.member("surface", air.nodes_surface);
  });
  json.member("of_grey_surface", air.of(air.grey_radiance));
  json.member("path", air.path);
  json.member("path_radiance", air.path_radiance);
  json.member("sky", air.sky);
  json.member("surface", air.surface);
  json.member("white_in_sky", air.white_in_sky);
}

void write_channel(JsonWriter& json, const render::ChannelInfo& channel, const ChannelStatistics& s) {
  if (channel.air) json.object("air_half_width", [&] { write_air(json, *channel.air); });
  json.member("centre_um", channel.centre_um);
  if (channel.detector)
    json.object("detector", [&] {
      for (const sensor::DetectorFigure& figure : sensor::detector_figures())
        if (const double value = (*channel.detector).*figure.value; value != 0.0)
          json.member(figure.name, value);
      if (const auto& rows = channel.detector->vignette_rows)
        json.list("vignette_rows", [&] {
          for (const std::array<double, 2>& row : *rows) json.value(row);
        });
    });
  json.member("fwhm_um", channel.fwhm_um);
  if (channel.inertia > 0.0) json.member("inertia", channel.inertia);
  if (channel.lag > 0.0) json.member("lag", channel.lag);
  json.member("largest_half_width", s.largest_half_width);
  json.member("maximum", s.maximum);
  json.member("mean", s.mean);
  json.member("mean_half_width", s.mean_half_width);
  if (s.parts)
    json.object("mean_half_width_parts", [&] {
      json.member("air", s.parts->air);
      if (channel.air && channel.air->model_counted > 0.0) json.member("model", s.parts->model);
      json.member("nodes", s.parts->nodes);
      json.member("sampling", s.parts->sampling);
    });
  json.member("minimum", s.minimum);
  json.member("name", channel.name);
  if (channel.noise > 0.0) json.member("noise", channel.noise);
  json.member("not_finite", s.not_finite);
  json.member("standard_deviation", s.standard_deviation);
  if (channel.toa_irradiance > 0.0) json.member("toa_irradiance", channel.toa_irradiance);
  if (!channel.toa_of_carried.empty() && channel.toa_irradiance > 0.0)
    json.member("toa_irradiance_of_carried", channel.toa_of_carried);
}

void write_cost(JsonWriter& json, const RunRecord& record) {
  const auto& s = record.statistics;
  json.member("elapsed_s", record.outcome.elapsed_s);
  json.object("rays", [&] {
    json.member("continuation", s.rays.continuation);
    json.member("primary", s.rays.primary);
    json.member("shadow", s.rays.shadow);
    json.member("total", s.rays.total());
  });
  json.object("samples", [&] {
    json.member("fewest_in_a_pixel", s.fewest_samples);
    json.member("halo", s.halo_samples);
    json.member("label_rays", s.label_rays);
    json.member("most_in_a_pixel", s.most_samples);
    json.member("probes", s.probe_samples);
    json.member("radiance_evaluations", s.radiance_evaluations);
    json.member("pilot_rays", s.pilot_samples);
    json.member("total", s.samples);
  });
  json.member("threads", record.outcome.threads);
}

void write_map(JsonWriter& json, const render::ImageInfo& info, bool has_system) {
  if (info.has_map) {
    json.member("gsd_m", info.gsd_m);
    json.member("rotation_rad", info.map_rotation_rad);
  }
  if (has_system)
    json.object("system", [&] {
      const MapSystem system = map_system(info);
      json.key("epsg");
      system.epsg > 0 ? json.value(system.epsg) : json.null();
      json.member("name", system.name);
      json.member("wkt", system.wkt);
    });
  if (info.has_map) {
    json.member("upper_left_x_m", info.map_x_m);
    json.member("upper_left_y_m", info.map_y_m);
  }
}

void write_image(JsonWriter& json, const render::ImageInfo& info, const std::string& interleave) {
  const bool has_system = !info.map_projection.empty() && info.map_projection != "Arbitrary";
  json.member("footprint_px", info.footprint_px);
  json.member("height_px", info.height_px);
  json.member("interleave", interleave);
  if (info.has_map || has_system) json.object("map", [&] { write_map(json, info, has_system); });
  json.member("materials", info.materials);
  if (info.mosaic)
    json.object("mosaic", [&] {
      json.member("channels", info.mosaic->channels);
      json.member("columns", info.mosaic->columns);
    });
  json.member("radiance_unit", info.radiance_unit);
  json.member("width_px", info.width_px);
}

void write_files(JsonWriter& json, const RunRecord& record) {
  for (const auto& file : record.files)
    json.object([&] {
      json.member("bytes", file.bytes);
      json.member("name", file.path.filename().string());
      json.member("sha256", file.sha256);
      json.member("what", file.what);
    });
}

}  // namespace

std::string to_json(const RunRecord& record) {
  const RunIdentity& identity = record.identity;
  JsonWriter json(JsonWriter::Layout::indented);
  json.object([&] {
    json.object("accuracy", [&] { write_accuracy(json, record); });
    json.object("acquisition", [&] { write_members(json, identity.acquisition); });
    json.list("channels", [&] {
      for (std::size_t c = 0; c < record.image.channels.size(); ++c)
        json.object([&] { write_channel(json, record.image.channels[c], record.statistics.channels.at(c)); });
    });
    json.object("cost", [&] { write_cost(json, record); });
    json.member("date", record.outcome.date);
    json.object("document", [&] {
      json.member("path", identity.document_path);
      json.member("text", identity.document_text);
    });
    json.list("files", [&] { write_files(json, record); });
    json.object("image", [&] { write_image(json, record.image, record.interleave); });
    json.member("notes", record.outcome.notes);
    json.object("program", [&] {
      json.member("name", "ifov");
      json.member("version", identity.version);
    });
    json.member("sampler", identity.sampler);
    json.member("seed", identity.seed);
  });
  return json.written();
}

}  // namespace ifov::io
