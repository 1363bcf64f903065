#include "ifov/assets.h"

#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "core/error.h"
#include "geometry/body.h"
#include "geometry/mesh_lists.h"
#include "geometry/triangle_mesh.h"
#include "io/files/inputs.h"
#include "io/instances/instance.h"
#include "io/raster/map_reference.h"
#include "io/raster/raster.h"
#include "io/scene_cache/file_stamp.h"
#include "session/facade/access.h"

namespace ifov {
namespace {

/// Of all arrays, one after the other, each with its length: none can lend numbers to its neighbour.
class Content {
 public:
  template <class T>
  Content& add(const std::vector<T>& values) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    bytes_ += bytes.size();
    const auto hash = io::content_hash(bytes);
    hashes_.insert(hashes_.end(), {bytes.size(), hash[0], hash[1]});
    return *this;
  }
  Content& add(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) add(std::vector<char>(text.begin(), text.end()));
    return add(std::vector<std::uint64_t>{texts.size()});
  }
  io::Assets::Asset of(std::any content, std::string what) const {
    return {std::move(content), std::move(what), bytes_, io::content_hash(std::as_bytes(std::span(hashes_)))};
  }

 private:
  std::uint64_t bytes_ = 0;
  std::vector<std::uint64_t> hashes_;
};

[[noreturn]] void refuse(const std::string& name, const std::string& message) {
  throw InputError(format("asset '{}': {}", name, message));
}

void require_length(const std::string& name, const char* what, std::size_t found, std::size_t expected,
                    const char* of_what) {
  if (found != expected)
    refuse(name, format("{} {}; expected {}, one for each {}", found, what, expected, of_what));
}

template <class Row>
void require_finite(const std::string& name, const char* what, const std::vector<Row>& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const double number : rows[k])
      if (!std::isfinite(number)) refuse(name, format("{} {} holds {}; expected numbers", what, k, number));
}

geometry::TriangleMesh mesh_of(const std::string& name, const MeshAsset& asset) {
  if (asset.triangles.empty()) refuse(name, "the mesh has no triangles");
  require_finite(name, "vertex", asset.vertices);
  require_finite(name, "normal", asset.normals);
  require_finite(name, "pair of texture coordinates", asset.uv);
  for (std::size_t k = 0; k < asset.triangles.size(); ++k)
    for (const std::uint32_t vertex : asset.triangles[k])
      if (vertex >= asset.vertices.size())
        refuse(name,
               format("triangle {} names vertex {}; there are {}, from 0", k, vertex, asset.vertices.size()));
  if (!asset.normals.empty())
    require_length(name, "normals", asset.normals.size(), asset.vertices.size(), "vertex");
  if (!asset.uv.empty())
    require_length(name, "pairs of texture coordinates", asset.uv.size(), asset.vertices.size(), "vertex");
  if (!asset.materials.empty())
    require_length(name, "materials", asset.materials.size(), asset.triangles.size(), "triangle");
  const std::size_t slots = std::max<std::size_t>(asset.material_names.size(), 1);
  for (std::size_t k = 0; k < asset.materials.size(); ++k)
    if (asset.materials[k] >= slots)
      refuse(name, format("triangle {} has material {}; material_names holds {}", k, asset.materials[k],
                          asset.material_names.size()));
  geometry::TriangleMesh mesh;
  for (const auto& v : asset.vertices) mesh.vertices_m.push_back({v[0], v[1], v[2]});
  mesh.triangles = asset.triangles;
  for (const auto& n : asset.normals) mesh.normals.push_back({n[0], n[1], n[2]});
  for (const auto& uv : asset.uv) mesh.uvs.push_back({uv[0], uv[1]});
  mesh.slots = asset.materials;
  mesh.slot_names = asset.material_names;
  geometry::check_mesh(geometry::lists_of(mesh));
  return mesh;
}

io::Raster raster_of(const std::string& name, const RasterAsset& asset) {
  if (asset.width < 1 || asset.height < 1 || asset.bands < 1)
    refuse(name, format("a raster of {} x {} cells and {} bands; expected 1 or more of each", asset.width,
                        asset.height, asset.bands));
  const std::size_t numbers = static_cast<std::size_t>(asset.width) * static_cast<std::size_t>(asset.height) *
                              static_cast<std::size_t>(asset.bands);
  if (asset.values.size() != numbers)
    refuse(name, format("{} values; expected {}: {} bands of {} rows of {}", asset.values.size(), numbers,
                        asset.bands, asset.height, asset.width));
  const auto bands = static_cast<std::size_t>(asset.bands);
  if (!asset.units.empty()) require_length(name, "units", asset.units.size(), bands, "band");
  if (asset.geotransform) require_finite(name, "geotransform", std::vector{*asset.geotransform});
  io::Raster raster;
  raster.width = asset.width, raster.height = asset.height, raster.bands = asset.bands;
  raster.geotransform = asset.geotransform;
  if (!asset.crs.empty()) raster.projection = io::MapReference(asset.crs).wkt();
  raster.values = asset.values;
  raster.nodata = asset.nodata;
  raster.units = asset.units.empty() ? std::vector<std::string>(bands) : asset.units;
  return raster;
}

std::vector<io::Instance> instances_of(const std::string& name, const CopiesAsset& asset) {
  const std::size_t count = asset.positions_m.size();
  require_finite(name, "position", asset.positions_m);
  if (!asset.yaw_rad.empty()) require_length(name, "yaws", asset.yaw_rad.size(), count, "position");
  if (!asset.scale.empty()) require_length(name, "scales", asset.scale.size(), count, "position");
  std::vector<io::Instance> instances;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& at = asset.positions_m[k];
    const double yaw = asset.yaw_rad.empty() ? 0.0 : asset.yaw_rad[k];
    const double scale = asset.scale.empty() ? 1.0 : asset.scale[k];
    if (!std::isfinite(yaw) || !std::isfinite(scale) || !(scale > 0.0))
      refuse(name,
             format("copy {} is turned by {:g} and scaled by {:g}; expected numbers, and a scale above 0", k,
                    yaw, scale));
    instances.push_back({{at[0], at[1], at[2]}, io::quaternion_of(yaw, 0.0, 0.0), {scale, scale, scale}});
  }
  return instances;
}

}  // namespace

struct Assets::Inside {
  io::Assets assets;
};

const io::Assets& FacadeAccess::inside(const Assets& assets) { return assets.inside_->assets; }

Assets::Assets() : inside_(std::make_shared<Inside>()) {}

void Assets::add(const std::string& name, const MeshAsset& mesh) {
  Content content;
  content.add(mesh.vertices).add(mesh.triangles).add(mesh.normals).add(mesh.uv);
  content.add(mesh.materials).add(mesh.material_names);
  inside_->assets.add(
      name, content.of(mesh_of(name, mesh), format("a mesh of {} triangles", mesh.triangles.size())));
}

void Assets::add(const std::string& name, const RasterAsset& raster) {
  Content content;
  content.add(std::vector<int>{raster.width, raster.height, raster.bands}).add(raster.values);
  using Transform = std::array<double, 6>;
  content.add(raster.geotransform ? std::vector<Transform>{*raster.geotransform} : std::vector<Transform>());
  content.add(std::vector<std::string>{raster.crs}).add(raster.units);
  content.add(raster.nodata ? std::vector<double>{*raster.nodata} : std::vector<double>());
  inside_->assets.add(name, content.of(raster_of(name, raster),
                                       format("a raster of {} x {} cells", raster.width, raster.height)));
}

void Assets::add(const std::string& name, const SpectrumAsset& spectrum) {
  if (spectrum.wavelengths.empty()) refuse(name, "the spectrum has no wavelengths");
  require_length(name, "values", spectrum.values.size(), spectrum.wavelengths.size(), "wavelength");
  require_finite(name, "the column", std::vector{spectrum.wavelengths, spectrum.values});
  Content content;
  content.add(spectrum.wavelengths).add(spectrum.values);
  inside_->assets.add(name, content.of(io::SpectrumColumns{spectrum.wavelengths, spectrum.values},
                                       format("a spectrum of {} wavelengths", spectrum.wavelengths.size())));
}

void Assets::add(const std::string& name, const CopiesAsset& copies) {
  Content content;
  content.add(copies.positions_m).add(copies.yaw_rad).add(copies.scale);
  inside_->assets.add(
      name, content.of(instances_of(name, copies), format("a list of {} copies", copies.positions_m.size())));
}

void Assets::add(const std::string& name, FileAsset file) {
  Content content;
  content.add(std::vector<std::string>{file.bytes});
  const std::size_t bytes = file.bytes.size();
  inside_->assets.add(name,
                      content.of(io::FileBytes{std::make_shared<const std::string>(std::move(file.bytes))},
                                 format("a file of {} bytes", bytes)));
}

std::vector<std::string> Assets::names() const { return inside_->assets.names(); }

}  // namespace ifov
