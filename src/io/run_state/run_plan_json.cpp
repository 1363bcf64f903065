#include <algorithm>

#include "core/error.h"
#include "io/files/own_files.h"
#include "io/json/json_adapter.h"
#include "io/json/json_view.h"
#include "io/json/json_writer.h"
#include "io/product_parts/acquisition_json.h"
#include "io/product_parts/sha256.h"
#include "io/products/product_format.h"
#include "io/quantities/identity_quantities.h"
#include "io/run_state/run_plan.h"
#include "radiometry/channel.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/detector/mosaic.h"
#include "sensor/spectrometer/column_responses.h"
#include "sensor/view_list.h"

namespace ifov::io {
namespace {

constexpr int kFormat = 6;

std::string hex(std::uint64_t value) { return format("{:016x}", value); }
std::uint64_t from_hex(const std::string& text) { return std::stoull(text, nullptr, 16); }

/// Of the state without white space, so that it can be told from the state as it was read.
std::string checksum_of(const std::string& compact) {
  Sha256 sum;
  sum.update(compact.data(), compact.size());
  return sum.digest();
}

constexpr std::pair<const char*, double render::AtmosphereHalfWidth::*> kAtmosphereKeys[] = {
    {"path", &render::AtmosphereHalfWidth::path},
    {"surface", &render::AtmosphereHalfWidth::surface},
    {"sky", &render::AtmosphereHalfWidth::sky},
    {"path_radiance", &render::AtmosphereHalfWidth::path_radiance},
    {"white_in_sky", &render::AtmosphereHalfWidth::white_in_sky},
    {"nodes_path", &render::AtmosphereHalfWidth::nodes_path},
    {"nodes_surface", &render::AtmosphereHalfWidth::nodes_surface},
    {"nodes_sky", &render::AtmosphereHalfWidth::nodes_sky},
    {"grey_radiance", &render::AtmosphereHalfWidth::grey_radiance},
    {"model_surface", &render::AtmosphereHalfWidth::model_surface},
    {"model_sunlight", &render::AtmosphereHalfWidth::model_sunlight},
    {"model_path", &render::AtmosphereHalfWidth::model_path},
    {"model_emission", &render::AtmosphereHalfWidth::model_emission},
    {"model_sky", &render::AtmosphereHalfWidth::model_sky},
    {"model_counted", &render::AtmosphereHalfWidth::model_counted},
    {"model_under_clouds", &render::AtmosphereHalfWidth::model_under_clouds},
    {"model_of_bands", &render::AtmosphereHalfWidth::model_of_bands}};

void write_views(JsonWriter& json, const sensor::ViewList& list) {
  json.object("views", [&] {
    json.member("kind", static_cast<int>(list.kind));
    json.list("columns", [&] {
      for (const sensor::ViewList::Column& column : list.columns)
        json.object([&] {
          json.member("name", column.name);
          json.member("unit", column.unit);
        });
    });
    json.member("values", list.values);
  });
}

std::shared_ptr<const sensor::ViewList> views_of(const JsonView& v) {
  auto list = std::make_shared<sensor::ViewList>();
  list->kind = static_cast<sensor::ViewList::Kind>(v["kind"].small_integer());
  for (const JsonView& column : v["columns"].items())
    list->columns.push_back({column["name"].text(), column["unit"].text()});
  for (const JsonView& value : v["values"].items()) list->values.push_back(value.number());
  return list;
}

/// A table of the response to energy; of a single wavelength none.
void write_response(JsonWriter& json, const char* key, const radiometry::Channel& channel) {
  json.object(key, [&] {
    json.member("wavelength_um", channel.response.wavelength_um());
    json.member("values", channel.response.values());
  });
}

/// A channel by detector column; the responses that paths carry of it where products need them.
void write_columns(JsonWriter& json, const render::ChannelInfo& channel,
                   const sensor::ColumnResponses::Channel& of, bool with_responses) {
  json.object("by_column", [&] {
    json.member("centre_um", of.columns.centre_um);
    json.member("fwhm_um", of.columns.fwhm_um);
    json.member("left_out", of.left_out);
    json.member("weights", of.weights);
    json.list("carried", [&] {
      for (std::size_t k = 0; k < of.carried.size(); ++k)
        json.object([&] {
          json.member("name", of.carried[k].name);
          json.member("centre_um", of.carried[k].centre_um);
          json.member("fwhm_um", of.carried[k].fwhm_um);
          if (!channel.toa_of_carried.empty()) json.member("toa_irradiance", channel.toa_of_carried[k]);
          if (with_responses) write_response(json, "response", of.carried[k]);
        });
    });
  });
}

std::vector<double> numbers_of(const JsonView& v) {
  std::vector<double> numbers;
  for (const JsonView& value : v.items()) numbers.push_back(value.number());
  return numbers;
}

radiometry::Channel response_of(const JsonView& v, const render::ChannelInfo& of) {
  const std::vector<double> wavelength_um = numbers_of(v["wavelength_um"]), values = numbers_of(v["values"]);
  return {of.name,
          wavelength_um.empty()
              ? radiometry::Spectrum::constant(values.at(0))
              : radiometry::Spectrum(wavelength_um, values, radiometry::OutsideRange::zero, of.name),
          of.centre_um, of.fwhm_um};
}

sensor::ColumnResponses::Channel columns_of(const JsonView& v, render::ChannelInfo& channel) {
  sensor::ColumnResponses::Channel of;
  of.columns = {numbers_of(v["centre_um"]), numbers_of(v["fwhm_um"])};
  of.left_out = v["left_out"].number();
  for (const double weight : numbers_of(v["weights"])) of.weights.push_back(static_cast<float>(weight));
  for (const JsonView& carried : v["carried"].items()) {
    const render::ChannelInfo named{carried["name"].text(), carried["centre_um"].number(),
                                    carried["fwhm_um"].number()};
    if (carried["toa_irradiance"].is_there())
      channel.toa_of_carried.push_back(carried["toa_irradiance"].number());
    of.carried.push_back({named.name, radiometry::Spectrum(), named.centre_um, named.fwhm_um});
    if (!carried["response"].is_there()) continue;
    of.carried.back() = response_of(carried["response"], named);
  }
  return of;
}

/// What of an image only some runs' products need.
struct WrittenWith {
  bool objects = false, responses = false;
};

void write_members(JsonWriter& json, const render::ImageInfo& image, WrittenWith with) {
  json.member("width_px", image.width_px);
  json.member("height_px", image.height_px);
  if (image.sweep_lines > 0) json.member("sweep_lines", image.sweep_lines);
  json.member("radiance_unit", image.radiance_unit);
  if (image.solved) json.member("solved_temperatures", true);
  json.member("footprint_px", image.footprint_px);
  json.list("channels", [&] {
    for (std::size_t c = 0; c < image.channels.size(); ++c)
      json.object([&] {
        const render::ChannelInfo& channel = image.channels[c];
        json.member("name", channel.name);
        json.member("centre_um", channel.centre_um);
        json.member("fwhm_um", channel.fwhm_um);
        if (channel.irradiance > 0.0) json.member("irradiance", channel.irradiance);
        if (channel.toa_irradiance > 0.0) json.member("toa_irradiance", channel.toa_irradiance);
        if (with.responses && channel.brightness)
          write_response(json, "response", channel.brightness->channel());
        if (image.responses) write_columns(json, channel, (*image.responses)[c], with.responses);
        if (!image.keystone_px.empty()) json.member("keystone_px", image.keystone_px[c]);
        if (channel.air)
          json.object("air", [&] {
            for (const auto& [key, member] : kAtmosphereKeys) json.member(key, (*channel.air).*member);
          });
      });
  });
  if (image.mosaic)
    json.object("mosaic", [&] {
      json.member("columns", image.mosaic->columns);
      json.member("channels", image.mosaic->channels);
    });
  if (image.stokes) json.member("stokes", true);
  json.member("materials", image.materials);
  if (with.objects)
    json.list("objects", [&] {
      for (std::size_t k = 0; k < image.objects.size(); ++k)
        json.object([&] {
          json.member("name", image.objects[k]);
          json.member("first", std::uint64_t{image.first_of_objects[k]});
        });
    });
  if (image.has_map)
    json.object("map", [&] {
      json.member("x_m", image.map_x_m);
      json.member("y_m", image.map_y_m);
      json.member("gsd_m", image.gsd_m);
      json.member("rotation_rad", image.map_rotation_rad);
    });
  json.member("map_system", image.map_projection);
  if (image.views) write_views(json, *image.views);
}

render::ImageInfo image_of(const JsonView& v) {
  render::ImageInfo image;
  image.width_px = v["width_px"].small_integer();
  image.height_px = v["height_px"].small_integer();
  if (v["sweep_lines"].is_there()) image.sweep_lines = v["sweep_lines"].small_integer();
  image.radiance_unit = v["radiance_unit"].text();
  image.solved = v["solved_temperatures"].is_there();
  image.footprint_px = v["footprint_px"].number();
  std::vector<sensor::ColumnResponses::Channel> by_column;
  for (const JsonView& c : v["channels"].items()) {
    image.channels.push_back({c["name"].text(), c["centre_um"].number(), c["fwhm_um"].number()});
    if (c["irradiance"].is_there()) image.channels.back().irradiance = c["irradiance"].number();
    if (c["toa_irradiance"].is_there()) image.channels.back().toa_irradiance = c["toa_irradiance"].number();
    if (c["response"].is_there())
      image.channels.back().brightness =
          std::make_shared<const sensor::BrightnessScale>(response_of(c["response"], image.channels.back()));
    if (c["by_column"].is_there()) by_column.push_back(columns_of(c["by_column"], image.channels.back()));
    if (c["keystone_px"].is_there()) image.keystone_px.push_back(numbers_of(c["keystone_px"]));
    if (!c["air"].is_there()) continue;
    render::AtmosphereHalfWidth& air = image.channels.back().air.emplace();
    for (const auto& [key, member] : kAtmosphereKeys) air.*member = c["air"][key].number();
  }
  if (!by_column.empty())
    image.responses = std::make_shared<const sensor::ColumnResponses>(std::move(by_column));
  for (const JsonView& name : v["materials"].items()) image.materials.push_back(name.text());
  if (const JsonView objects = v["objects"]; objects.is_there())
    for (const JsonView& object : objects.items()) {
      image.objects.push_back(object["name"].text());
      image.first_of_objects.push_back(static_cast<std::uint32_t>(object["first"].natural()));
    }
  if (const JsonView told = v["mosaic"]; told.is_there()) {
    auto mosaic = std::make_shared<sensor::Mosaic>();
    mosaic->columns = told["columns"].small_integer();
    for (const JsonView& channel : told["channels"].items())
      mosaic->channels.push_back(channel.small_integer());
    mosaic->rows = static_cast<int>(mosaic->channels.size()) / mosaic->columns;
    image.mosaic = std::move(mosaic);
  }
  image.stokes = v["stokes"].is_there() && v["stokes"].boolean();
  if (const JsonView map = v["map"]; map.is_there()) {
    image.has_map = true;
    image.map_x_m = map["x_m"].number();
    image.map_y_m = map["y_m"].number();
    image.gsd_m = map["gsd_m"].number();
    image.map_rotation_rad = map["rotation_rad"].number();
  }
  image.map_projection = v["map_system"].text();
  if (v["views"].is_there()) image.views = views_of(v["views"]);
  return image;
}

void write_products(JsonWriter& json, const RunPlan& plan) {
  std::vector<std::string_view> cubes;
  for (const Quantity* quantity : plan.cubes) cubes.push_back(quantity->name);
  std::vector<std::string_view> formats;
  for (const ProductFormat* format : plan.formats.list())
    if (!format->name.empty()) formats.push_back(format->name);
  json.member("name", plan.name);
  json.member("cubes", cubes);
  json.member("interleave", plan.interleave);
  json.member("formats", formats);
  json.member("quicklook_channels", plan.quicklook_channels);
}

void write_members(JsonWriter& json, const RunPlan& plan) {
  const RunIdentity& identity = plan.identity;
  json.object("program", [&] {
    json.member("version", identity.version);
    json.member("build", plan.build);
  });
  json.member("instruction_set", plan.instruction_set);
  json.object("document", [&] {
    json.member("path", identity.document_path);
    json.member("text", identity.document_text);
  });
  json.member("seed", identity.seed);
  json.member("sampler", identity.sampler);
  json.object("accuracy", [&] {
    json.member("asked", identity.accuracy_asked);
    json.member("confidence", identity.confidence);
    json.member("judged", plan.judged);
    json.member("image_wide", plan.image_wide);
    json.member("knows_errors", plan.knows_errors);
    json.member("error", plan.error);
    json.member("unit", plan.error_unit);
  });
  json.object("refining", [&] {
    json.member("keeps_memory", plan.keeps_memory);
    json.member("base", hex(plan.base));
    json.member("from", plan.refined_from);
  });
  json.member("tile_px", plan.tile_px);
  json.object("share", [&] {
    json.member("number", plan.share.number);
    json.member("count", plan.share.count);
  });
  json.object("image", [&] {
    write_members(json, plan.image,
                  {plan.cubes.has(quantities::kObjectClass),
                   std::any_of(plan.cubes.begin(), plan.cubes.end(),
                               [](const Quantity* quantity) { return quantity->needs.responses; })});
  });
  json.list("files", [&] {
    for (const FileStamp& file : plan.files)
      json.object([&] {
        json.member("path", file.path);
        json.member("bytes", file.bytes);
        json.member("time_ns", file.time_ns);
        json.member("xxh3_128", hex(file.hash[1]) + hex(file.hash[0]));
      });
  });
  json.member("notes", plan.notes);
  json.object("acquisition", [&] { write_members(json, identity.acquisition); });
  json.object("products", [&] { write_products(json, plan); });
}

std::string compact_state(const RunPlan& plan) {
  JsonWriter json(JsonWriter::Layout::compact);
  json.object([&] { write_members(json, plan); });
  return json.written();
}

RunPlan plan_of(const JsonView& v) {
  RunPlan plan;
  plan.identity = {v["program"]["version"].text(),
                   v["document"]["path"].text(),
                   v["document"]["text"].text(),
                   v["seed"].natural(),
                   v["sampler"].text(),
                   v["accuracy"]["asked"].text(),
                   v["accuracy"]["confidence"].number(),
                   acquisition_of(v["acquisition"])};
  plan.build = v["program"]["build"].text();
  plan.instruction_set = v["instruction_set"].text();
  plan.judged = v["accuracy"]["judged"].boolean();
  const JsonView image_wide = v["accuracy"]["image_wide"];
  plan.image_wide = image_wide.is_there() && image_wide.boolean();
  plan.knows_errors = v["accuracy"]["knows_errors"].boolean();
  plan.error = v["accuracy"]["error"].number();
  plan.error_unit = v["accuracy"]["unit"].text();
  plan.keeps_memory = v["refining"]["keeps_memory"].boolean();
  plan.base = from_hex(v["refining"]["base"].text());
  for (const JsonView& accuracy : v["refining"]["from"].items()) plan.refined_from.push_back(accuracy.text());
  plan.tile_px = v["tile_px"].small_integer();
  plan.share = {v["share"]["number"].small_integer(), v["share"]["count"].small_integer()};
  plan.image = image_of(v["image"]);
  for (const JsonView& f : v["files"].items()) {
    const std::string hash = f["xxh3_128"].text();
    plan.files.push_back({f["path"].text(),
                          f["bytes"].natural(),
                          f["time_ns"].integer(),
                          {from_hex(hash.substr(16)), from_hex(hash.substr(0, 16))}});
  }
  for (const JsonView& note : v["notes"].items()) plan.notes.push_back(note.text());
  plan.name = v["products"]["name"].text();
  plan.cubes = {};
  for (const JsonView& name : v["products"]["cubes"].items())
    if (const Quantity* quantity = find_quantity(name.text())) plan.cubes.add(*quantity);
  plan.interleave = v["products"]["interleave"].text("bil");
  for (const JsonView& name : v["products"]["formats"].items())
    if (const ProductFormat* format = find_product_format(name.text())) plan.formats.add(*format);
  for (const JsonView& channel : v["products"]["quicklook_channels"].items())
    plan.quicklook_channels.push_back(channel.small_integer());
  return plan;
}

bool is_sound(const RunPlan& plan) {
  return plan.image.width_px > 0 && plan.image.height_px > 0 && plan.tile_px > 0 &&
         plan.image.sweep_lines >= 0 && !plan.image.channels.empty() && plan.share.count > 0 &&
         plan.share.number > 0 && plan.share.number <= plan.share.count;
}

}  // namespace

std::string to_json(const RunPlan& plan) {
  JsonWriter json(JsonWriter::Layout::indented);
  json.object([&] {
    json.member("format", kFormat);
    json.member("sha256", checksum_of(compact_state(plan)));
    json.object("state", [&] { write_members(json, plan); });
  });
  return json.written();
}

RunPlan plan_in(const std::string& text, const std::string& name) {
  const SystemError damaged(
      format("{}: it is damaged; what it belongs to cannot be known, so its tiles cannot be "
             "used: start anew with --restart",
             name));
  JsonRules rules;
  rules.comments = false;
  rules.max_bytes = rules.max_values = text.size();
  try {
    const DocumentTree tree = parse_json(text, name, rules);
    const JsonView root(tree);
    if (const JsonView found = root["format"]; found.is_number() && found.integer() != kFormat)
      throw SystemError(
          format("{}: it is of format {}, this program reads format {}: go on with the program that "
                 "wrote it, or start anew with --restart",
                 name, found.integer(), kFormat));
    const DocumentNode* state =
        tree.root->type() == DocumentNode::Type::object ? tree.root->find("state") : nullptr;
    if (state == nullptr) throw damaged;
    JsonWriter compact(JsonWriter::Layout::compact);
    compact.node(*state);
    if (root["sha256"].text() != checksum_of(compact.written())) throw damaged;
    const RunPlan plan = plan_of(root["state"]);
    if (!is_sound(plan)) throw damaged;
    return plan;
  } catch (const InputError&) {
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
