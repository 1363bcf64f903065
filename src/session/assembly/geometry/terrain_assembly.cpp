#include "session/assembly/geometry/terrain_assembly.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "geometry/terrain_mesh.h"
#include "io/raster/elevation.h"
#include "io/raster/raster.h"
#include "io/scene_cache/cache_writer.h"
#include "io/scene_cache/scene_cache.h"
#include "session/assembly/geometry/mesh_cache.h"

namespace ifov::session {

namespace {

/// The file's georeference, or the one that the document gives instead, as Raster::geotransform.
std::array<double, 6> georeference(const io::TerrainShape& source, const io::Elevation& elevation) {
  if (source.placement) {
    const io::RasterDocument::Placement& placement = *source.placement;
    return {placement.x_m, placement.width_m / elevation.width,   0.0, placement.y_m + placement.height_m,
            0.0,           -placement.height_m / elevation.height};
  }
  if (elevation.geotransform) return *elevation.geotransform;
  throw InputError(format("the raster '{}' has no georeference; give low_left and size", source.file.path));
}

geometry::TerrainGrid grid_of(const io::TerrainShape& source, io::Elevation elevation,
                              const MapFrame& frame) {
  geometry::TerrainGrid grid;
  grid.columns = elevation.width;
  grid.rows = elevation.height;
  grid.height_m = std::move(elevation.height_m);
  const std::array<double, 6> t = georeference(source, elevation);
  const math::Vec3 offset_m = frame.offset_m();
  grid.corner_m = {t[0] + 0.5 * (t[1] + t[2]) - offset_m.x, t[3] + 0.5 * (t[4] + t[5]) - offset_m.y,
                   -offset_m.z};
  grid.along_column_m = {t[1], t[4], 0.0};
  grid.along_row_m = {t[2], t[5], 0.0};
  const auto transform =
      source.placement ? nullptr : frame.transform_from(elevation.projection, source.file.path);
  if (!transform) return grid;
  std::vector<io::MapPoint> points;
  points.reserve(grid.height_m.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      points.push_back({t[0] + (column + 0.5) * t[1] + (row + 0.5) * t[2],
                        t[3] + (column + 0.5) * t[4] + (row + 0.5) * t[5]});
  transform->apply(points);
  for (const io::MapPoint& point : points)
    grid.positions_m.push_back({point.x - offset_m.x, point.y - offset_m.y});
  return grid;
}

/// What was said of a terrain, on two lines: how it was meshed, and a warning or nothing.
std::string words_of(const io::TerrainShape& source, const geometry::TerrainGrid& grid,
                     const geometry::TerrainMesh& terrain, std::size_t unknown) {
  const std::string name = std::filesystem::path(source.file.path).filename().string();
  std::string text =
      format("terrain '{}': {} x {} heights, {} triangles, largest height error {:.3g} m", name, grid.columns,
             grid.rows, terrain.mesh.triangles.size(), terrain.largest_height_error_m);
  if (!grid.positions_m.empty())
    text += format(", largest shift on the map {:.3g} m", terrain.largest_shift_m);
  text += '\n';
  if (unknown > 0)
    text += format("terrain '{}': {} of {} cells have no height; they are {}", name, unknown,
                   grid.height_m.size(), source.fill ? "filled from their neighbours" : "holes");
  return text;
}

/// The raster, the files beside it that GDAL looks at, and all else that its mesh depends on.
MeshSource source_of(const io::TerrainShape& s, const MapFrame& frame) {
  MeshSource source{{s.file.path}, {}, {}};
  const std::filesystem::path path = s.file.path;
  std::vector<std::filesystem::path> companions{s.file.path + ".aux.xml", s.file.path + ".hdr"};
  for (const char* extension : {".aux.xml", ".hdr", ".prj", ".tfw", ".wld", ".img", ".bil", ".flt", ".sdat"})
    companions.push_back(std::filesystem::path(path).replace_extension(extension));
  std::error_code error;
  for (const auto& companion : companions)
    if (companion != path && std::filesystem::is_regular_file(companion, error))
      source.files.push_back(companion.string());
  const math::Vec3 offset_m = frame.offset_m();
  source.more =
      format(" terrain band {} detail {} unit {} fill {} smooth {} offset {} {} {}", s.band, s.detail_m,
             s.unit_m.value_or(0.0), s.fill, s.smooth, offset_m.x, offset_m.y, offset_m.z);
  if (s.placement)
    source.more += format(" placed {} {} {} {}", s.placement->x_m, s.placement->y_m, s.placement->width_m,
                          s.placement->height_m);
  if (frame.reference() != nullptr) {
    const std::string wkt = frame.reference()->wkt();
    source.more += format(" reference {:x}", io::cache_hash(std::as_bytes(std::span(wkt))));
  }
  return source;
}

}  // namespace

bool is_traced_in_raster(const io::TerrainShape& source, const MapFrame& frame, bool in_prototype) {
  using Form = io::TerrainShape::Form;
  if (source.form || in_prototype || source.detail_m > 0.0) return source.form == Form::grid;
  constexpr std::size_t kLargeMesh_cells = 1'000'000;  // some 300 MB of triangles and their tree
  const io::RasterFrame raster = io::read_raster_frame(source.file.path);
  return raster.cells() > kLargeMesh_cells &&
         (source.placement || frame.transform_from(raster.projection, source.file.path) == nullptr);
}

std::shared_ptr<const geometry::HeightField> assemble_height_field(const io::TerrainShape& source,
                                                                   const MapFrame& frame, LogSink* log) {
  if (source.detail_m > 0.0)
    throw InputError(
        format("a terrain of the form 'grid' keeps every height: found a detail of {:g} m, expected 0 m or "
               "the form 'mesh'",
               source.detail_m));
  io::Elevation elevation =
      io::read_elevation(source.file.path, source.band, source.unit_m,
                         source.fill ? io::UnknownHeights::fill : io::UnknownHeights::holes);
  const std::size_t unknown = elevation.unknown;
  geometry::TerrainGrid grid = grid_of(source, std::move(elevation), frame);
  if (!grid.positions_m.empty())
    throw InputError(
        format("a terrain of the form 'grid' must be in the scene's own coordinates: '{}' is in others; give "
               "the scene "
               "the 'crs' of the raster, or use the form 'mesh'",
               source.file.path));
  const int columns = grid.columns, rows = grid.rows;
  auto field = std::make_shared<geometry::HeightField>(std::move(grid), source.smooth);
  if (log != nullptr) {
    const std::string name = std::filesystem::path(source.file.path).filename().string();
    log->info(format("terrain '{}': {} x {} heights, traced as a grid of {} triangles", name, columns, rows,
                     field->triangles()));
    if (unknown > 0)
      log->warn(format("terrain '{}': {} of {} cells have no height; they are {}", name, unknown,
                       static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                       source.fill ? "filled from their neighbours" : "holes"));
  }
  return field;
}

geometry::Body assemble_terrain(const io::TerrainShape& source, const MapFrame& frame, io::SceneCache* cache,
                                LogSink* log) {
  std::string words;
  const auto read = [&] {
    io::Elevation elevation =
        io::read_elevation(source.file.path, source.band, source.unit_m,
                           source.fill ? io::UnknownHeights::fill : io::UnknownHeights::holes);
    const std::size_t unknown = elevation.unknown;
    const geometry::TerrainGrid grid = grid_of(source, std::move(elevation), frame);
    geometry::TerrainMesh terrain = geometry::mesh_terrain(grid, source.detail_m, source.smooth);
    words = words_of(source, grid, terrain, unknown);
    return std::move(terrain.mesh);
  };
  geometry::Body body = cached_mesh(cache, source_of(source, frame), read, &words);
  if (log != nullptr) {
    const std::size_t end = words.find('\n');
    log->info(words.substr(0, end));
    if (end + 1 < words.size()) log->warn(words.substr(end + 1));
  }
  return body;
}

}  // namespace ifov::session
