#include "io/product_parts/stac_item.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/format.h"
#include "geodesy/utc_time.h"
#include "io/json/json_writer.h"
#include "io/product_parts/map_info.h"
#include "io/quantities/quantity.h"
#include "io/quantities/quantity_set.h"
#include "io/raster/map_reference.h"

namespace ifov::io {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kPlacesOfSide = 32;  // of an outline, at most

double turn(StacPlace a, StacPlace b, StacPlace c) {
  return (b.longitude_deg - a.longitude_deg) * (c.latitude_deg - a.latitude_deg) -
         (b.latitude_deg - a.latitude_deg) * (c.longitude_deg - a.longitude_deg);
}

double area(const StacRing& ring) {
  double twice = 0.0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) twice += turn(ring[0], ring[k], ring[k + 1]);
  return 0.5 * twice;
}

bool cross(StacPlace a, StacPlace b, StacPlace c, StacPlace d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

bool crosses_itself(const StacRing& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 2; k < n; ++k)
      if (cross(ring[i], ring[(i + 1) % n], ring[k], ring[(k + 1) % n])) return true;
  return false;
}

/// By Andrew's chains.
StacRing hull(StacRing places) {
  std::sort(places.begin(), places.end(), [](StacPlace a, StacPlace b) {
    return a.longitude_deg < b.longitude_deg ||
           (a.longitude_deg == b.longitude_deg && a.latitude_deg < b.latitude_deg);
  });
  StacRing ring;
  for (const bool upper : {false, true}) {
    const std::size_t first = ring.size();
    for (const StacPlace place : places) {
      while (ring.size() >= first + 2 && turn(ring[ring.size() - 2], ring.back(), place) <= 0.0)
        ring.pop_back();
      ring.push_back(place);
    }
    ring.pop_back();
    if (!upper) std::reverse(places.begin(), places.end());
  }
  return ring;
}

/// The part of a ring with `side` (longitude - 180) >= 0.
StacRing beyond_date_line(const StacRing& ring, double side) {
  StacRing part;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const StacPlace a = ring[k], b = ring[(k + 1) % ring.size()];
    const double from = side * (a.longitude_deg - 180.0), to = side * (b.longitude_deg - 180.0);
    if (from >= 0.0) part.push_back(a);
    if (from * to < 0.0)
      part.push_back({180.0, a.latitude_deg + (b.latitude_deg - a.latitude_deg) * from / (from - to)});
  }
  return part;
}

/// Where the pixels along the image's rim lie, clockwise as the image is looked at, those that see something.
std::vector<MapPoint> rim(const WideView& location) {
  std::vector<std::pair<int, int>> pixels;  // column, line
  const int right = location.width - 1, low = location.height - 1;
  const auto side = [&](int from_x, int from_y, int to_x, int to_y) {
    const int steps =
        std::clamp(std::max(std::abs(to_x - from_x), std::abs(to_y - from_y)), 1, kPlacesOfSide);
    for (int k = 0; k < steps; ++k)
      pixels.emplace_back(from_x + static_cast<int>(static_cast<std::int64_t>(to_x - from_x) * k / steps),
                          from_y + static_cast<int>(static_cast<std::int64_t>(to_y - from_y) * k / steps));
  };
  side(0, 0, right, 0), side(right, 0, right, low), side(right, low, 0, low), side(0, low, 0, 0);
  std::vector<MapPoint> places;
  std::vector<double> x(static_cast<std::size_t>(location.width)), y(x.size());
  for (const auto& [column, line] : pixels) {
    location.read(line, 0, x);
    location.read(line, 1, y);
    const auto at = static_cast<std::size_t>(column);
    if (std::isfinite(x[at]) && std::isfinite(y[at])) places.push_back({x[at], y[at]});
  }
  return places;
}

/// Of the image, as well as it is known; empty where it is not known where on the Earth.
StacRing outline_of(const RunRecord& record, const WideView& location) {
  const render::ImageInfo& image = record.image;
  StacRing outline;
  const bool is_placed = !image.map_projection.empty() && image.map_projection != "Arbitrary";
  std::vector<MapPoint> places;
  if (is_placed && image.has_map) {
    const std::array<double, 6> g = geotransform(image);
    const double width = image.width_px, height = image.height_px;
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {width, 0.0}, {width, height}, {0.0, height}})
      places.push_back({g[0] + x * g[1] + y * g[2], g[3] + x * g[4] + y * g[5]});
  } else if (is_placed && location) {
    places = rim(location);
  }
  if (places.size() >= 3) {
    try {
      MapTransform(MapReference(image.map_projection), MapReference("EPSG:4326")).apply(places);
      for (const MapPoint place : places) outline.push_back({place.x, place.y});
      return outline;
    } catch (const InputError&) {  // a place far outside of the projection
      outline.clear();
    }
  }
  for (const auto& corner : record.identity.acquisition.footprint)
    if (corner && corner->position)
      outline.push_back({corner->position->longitude_deg, corner->position->latitude_deg});
  return outline;
}

void write_ring(JsonWriter& json, const StacRing& ring) {
  json.list([&] {
    for (std::size_t k = 0; k <= ring.size(); ++k) {
      const StacPlace place = ring[k % ring.size()];
      json.value(std::array{place.longitude_deg, place.latitude_deg});
    }
  });
}

void write_geometry(JsonWriter& json, const std::vector<StacRing>& rings) {
  if (rings.empty()) {
    json.key("geometry");
    json.null();
    return;
  }
  json.object("geometry", [&] {
    json.member("type", rings.size() == 1 ? "Polygon" : "MultiPolygon");
    json.list("coordinates", [&] {
      for (const StacRing& ring : rings)
        if (rings.size() == 1)
          write_ring(json, ring);
        else
          json.list([&] { write_ring(json, ring); });
    });
  });
  // Over the date line west is greater than east.
  const auto extreme = [](const StacRing& ring, double StacPlace::*part, bool most) {
    double found = ring.front().*part;
    for (const StacPlace place : ring)
      found = most ? std::max(found, place.*part) : std::min(found, place.*part);
    return found;
  };
  double south = 90.0, north = -90.0;
  for (const StacRing& ring : rings) {
    south = std::min(south, extreme(ring, &StacPlace::latitude_deg, false));
    north = std::max(north, extreme(ring, &StacPlace::latitude_deg, true));
  }
  json.member("bbox", std::array{extreme(rings.front(), &StacPlace::longitude_deg, false), south,
                                 extreme(rings.back(), &StacPlace::longitude_deg, true), north});
}

std::string seconds_later(const std::string& time, double seconds) {
  geodesy::UtcTime at = geodesy::parse_utc(time);
  at.jd2 += seconds / 86400.0;
  return geodesy::format_utc(at);
}

void write_times(JsonWriter& json, const RunRecord& record) {
  const Acquisition& acquisition = record.identity.acquisition;
  if (acquisition.time.empty()) {
    json.member("datetime", record.outcome.date);
    return;
  }
  if (acquisition.camera.lines.empty()) {
    json.member("datetime", acquisition.time);
    return;
  }
  const double first = acquisition.camera.lines.front().time_s, last = acquisition.camera.lines.back().time_s;
  json.member("datetime", seconds_later(acquisition.time, 0.5 * (first + last)));
  json.member("start_datetime", seconds_later(acquisition.time, std::min(first, last)));
  json.member("end_datetime", seconds_later(acquisition.time, std::max(first, last)));
}

bool tells_sun(const Acquisition& acquisition) { return acquisition.light && !acquisition.light->is_moon; }

/// An item that names the extension has to have one of its fields.
bool tells_view(const Acquisition& acquisition) {
  return acquisition.camera.forward.z < 0.0 || tells_sun(acquisition);
}

/// Angles of the middle of the image.
void write_view(JsonWriter& json, const Acquisition& acquisition) {
  constexpr double kEarth_m = 6371000.0;
  const math::Vec3 sight = acquisition.camera.forward;
  if (sight.z < 0.0) {
    const double aside = std::hypot(sight.x, sight.y);
    math::Vec3 nadir{0.0, 0.0, -1.0};
    if (acquisition.camera
            .position_m) {  // the Earth is round: from orbit the nadir is another direction than at the scene
      const math::Vec3 sensor = *acquisition.camera.position_m - acquisition.origin_on_map_m,
                       centre{0.0, 0.0, -(kEarth_m + acquisition.origin_height_m)};
      nadir = (centre - sensor) / length(centre - sensor);
    }
    json.member("view:off_nadir",
                std::atan2(length(math::cross(nadir, sight)), dot(nadir, sight)) * kDegrees);
    json.member("view:incidence_angle", std::atan2(aside, -sight.z) * kDegrees);
    if (aside > 1e-9) {
      const double azimuth_deg = std::atan2(-sight.x, -sight.y) * kDegrees;
      json.member("view:azimuth", azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg);
    }
  }
  if (!tells_sun(acquisition)) return;
  json.member("view:sun_azimuth", acquisition.light->azimuth_deg);
  json.member("view:sun_elevation", 90.0 - acquisition.light->zenith_deg);
}

void write_projection(JsonWriter& json, const render::ImageInfo& image) {
  const bool is_placed = !image.map_projection.empty() && image.map_projection != "Arbitrary";
  std::optional<int> code;
  if (is_placed && image.has_map) {
    if (const MapSystem system = map_system(image); system.epsg != 0) code = system.epsg;
  }
  // What is not on the map has no code, nor has a system of the scene's own.
  if (code) {
    json.member("proj:epsg", *code);
  } else {
    json.key("proj:epsg");
    json.null();
  }
  json.member("proj:shape", std::array{image.height_px, image.width_px});
  if (!image.has_map) return;
  if (is_placed && !code) json.member("proj:wkt2", wkt2_text(image));
  const std::array<double, 6> g = geotransform(image);
  json.member("proj:transform",
              std::array{g[1] + 0.0, g[2] + 0.0, g[0] + 0.0, g[4] + 0.0, g[5] + 0.0, g[3] + 0.0});
}

/// Without the last digits, which differences of what a document gives leave: 0.45 of 0.5 um is 0.05 um wide.
double as_given(double value) {
  const std::string text = format("{:.12g}", value);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void write_asset(JsonWriter& json, const StacAsset& asset, const std::string& file, const ProductFile* known,
                 const render::ImageInfo& image) {
  json.object(asset.key, [&] {
    json.member("href", "./" + file);
    json.member("title", known != nullptr ? known->what : file);
    json.member("type", asset.media_type);
    json.member("roles", asset.roles);
    if (known != nullptr && !known->sha256.empty()) {
      json.member("file:size", known->bytes);
      json.member("file:checksum", "1220" + known->sha256);  // a multihash: SHA-256, of 32 bytes
    }
    if (asset.has_channels)
      json.list("eo:bands", [&] {
        for (const render::ChannelInfo& channel : image.channels)
          json.object([&] {
            json.member("name", channel.name);
            json.member("center_wavelength", as_given(channel.centre_um));
            json.member("full_width_half_max", as_given(channel.fwhm_um));
          });
      });
  });
}

/// "street" of "scenes/street.json", and what tells this run's folder from others of the document.
std::string id_of(const RunRecord& record, const std::filesystem::path& path, const std::string& stem) {
  std::string id = std::filesystem::path(record.identity.document_path).stem().string();
  std::error_code ignored;
  const std::filesystem::path folder =
      std::filesystem::absolute(path, ignored).lexically_normal().parent_path();
  const std::string last = folder.extension() == ".out" ? folder.stem().string() : folder.filename().string();
  if (id.empty()) id = "ifov";
  if (!last.empty() && last != id) id += "_" + last;
  if (stem != "image") id += "_" + stem;
  return id;
}

}  // namespace

StacAsset stac_asset(const std::string& file, const std::string& stem) {
  const std::string rest = file.starts_with(stem + "_") ? file.substr(stem.size() + 1) : file;
  const std::size_t dot = rest.find('.');
  const std::string word = rest.substr(0, dot), ending = dot == std::string::npos ? "" : rest.substr(dot);
  if (ending == ".img.hdr") return {word + "_header", "text/plain", {"metadata"}};
  if (ending == ".tif")
    return {"geotiff", "image/tiff; application=geotiff; profile=cloud-optimized", {"data"}, true};
  if (ending == ".nc") return {"netcdf", "application/netcdf", {"data"}, true};
  if (ending == ".vrt") return {"vrt", "application/xml", {"data"}, true};
  if (ending == ".qml") return {"style", "application/xml", {"metadata"}};
  if (ending == ".png") return {word, "image/png", {"overview"}};
  if (ending == ".html") return {word, "text/html", {"metadata"}};
  if (ending == ".json") return {word, "application/json", {"metadata"}};
  StacAsset asset{word, "application/octet-stream", {"data"}};
  if (const Quantity* const quantity = find_quantity(word)) {
    asset.has_channels = quantity->is_spectral();
    if (quantity->role == Quantity::Role::error) asset.roles.emplace_back("uncertainty");
    if (quantity->role == Quantity::Role::judgement) asset.roles = {"metadata", "quality"};
    if (quantity->role == Quantity::Role::count) asset.roles = {"metadata"};
    if (word == "toa_reflectance") asset.roles.emplace_back("reflectance");
    if (word == "brightness_temperature") asset.roles.emplace_back("temperature");
  } else {
    asset.has_channels = word == "demosaiced";
  }
  return asset;
}

std::vector<StacRing> stac_polygons(StacRing outline) {
  const auto same = [](StacPlace a, StacPlace b) {
    return a.longitude_deg == b.longitude_deg && a.latitude_deg == b.latitude_deg;
  };
  outline.erase(std::unique(outline.begin(), outline.end(), same), outline.end());
  while (outline.size() > 1 && same(outline.front(), outline.back())) outline.pop_back();
  if (outline.size() < 3) return {};
  const auto [west, east] = std::minmax_element(outline.begin(), outline.end(), [](StacPlace a, StacPlace b) {
    return a.longitude_deg < b.longitude_deg;
  });
  const bool over_date_line = east->longitude_deg - west->longitude_deg > 180.0;
  if (over_date_line)
    for (StacPlace& place : outline)
      if (place.longitude_deg < 0.0) place.longitude_deg += 360.0;
  if (crosses_itself(outline)) outline = hull(outline);
  if (area(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  if (outline.size() < 3 || area(outline) == 0.0) return {};
  if (!over_date_line) return {outline};
  std::vector<StacRing> parts{beyond_date_line(outline, -1.0), beyond_date_line(outline, 1.0)};
  for (StacPlace& place : parts[1]) place.longitude_deg -= 360.0;
  std::erase_if(parts, [](const StacRing& ring) { return ring.size() < 3; });
  return parts;
}

std::string stac_item(const RunRecord& record, const WideView& location, const std::filesystem::path& path,
                      const std::string& stem) {
  const std::string document = std::filesystem::path(record.identity.document_path).filename().string();
  JsonWriter json(JsonWriter::Layout::indented);
  json.object([&] {
    json.member("type", "Feature");
    json.member("stac_version", "1.0.0");
    std::vector<std::string> extensions;
    for (const char* const extension :
         {"eo/v1.1.0", "file/v2.1.0", "processing/v1.1.0", "projection/v1.1.0", "view/v1.0.0"})
      if (extension[0] != 'v' || tells_view(record.identity.acquisition))
        extensions.push_back(format("https://stac-extensions.github.io/{}/schema.json", extension));
    json.member("stac_extensions", extensions);
    json.member("id", id_of(record, path, stem));
    write_geometry(json, stac_polygons(outline_of(record, location)));
    json.object("properties", [&] {
      write_times(json, record);
      json.member("title", format("{}, rendered by ifov {}", document, record.identity.version));
      if (const double gsd_m = record.identity.acquisition.camera.ground_sample_m; gsd_m > 0.0)
        json.member("gsd", gsd_m);
      write_projection(json, record.image);
      write_view(json, record.identity.acquisition);
      json.object("processing:software", [&] { json.member("ifov", record.identity.version); });
      json.member("ifov:asked", record.identity.accuracy_asked);
      json.member("ifov:reached", record.outcome.accuracy_statement);
    });
    json.list("links", [] {});
    json.object("assets", [&] {
      for (const ProductFile& file : record.files) {
        const std::string name = file.path.filename().string();
        const StacAsset asset = stac_asset(name, stem);
        write_asset(json, asset, name, &file, record.image);
        if (name.ends_with(".img"))
          write_asset(json, stac_asset(name + ".hdr", stem), name + ".hdr", nullptr, record.image);
      }
      const std::string run = stem + "_run.json";
      const ProductFile told{run, "run record", 0, {}};
      write_asset(json, stac_asset(run, stem), run, &told, record.image);
    });
  });
  return json.written();
}

}  // namespace ifov::io
