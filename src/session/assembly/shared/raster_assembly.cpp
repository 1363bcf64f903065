#include "session/assembly/shared/raster_assembly.h"

#include "core/error.h"

namespace ifov::session {

namespace {

materials::Tiling tiling_of(io::Tiling tiling) {
  switch (tiling) {
    case io::Tiling::edge: return materials::Tiling::edge;
    case io::Tiling::repeat: return materials::Tiling::repeat;
    case io::Tiling::mirror: return materials::Tiling::mirror;
  }
  return materials::Tiling::edge;
}

}  // namespace

materials::MapGrid grid_of(const io::RasterDocument& source, const io::Raster& raster,
                           const MapFrame& frame) {
  materials::MapGrid grid;
  grid.width = raster.width;
  grid.height = raster.height;
  grid.tiling = tiling_of(source.tiling);
  if (source.by_texture) {
    grid.by = materials::MapBy::texture_coordinates;
    grid.west_m = 0.0;
    grid.north_m = 1.0 / source.copies[1];
    grid.cell_width_m = 1.0 / (source.copies[0] * raster.width);
    grid.cell_height_m = 1.0 / (source.copies[1] * raster.height);
    return grid;
  }
  if (source.placement) {
    const io::RasterDocument::Placement& placement = *source.placement;
    grid.cell_width_m = placement.width_m / raster.width;
    grid.cell_height_m = placement.height_m / raster.height;
    grid.west_m = placement.x_m;
    grid.north_m = placement.y_m + placement.height_m;
  } else if (raster.geotransform) {
    const std::array<double, 6>& t = *raster.geotransform;
    if (t[2] != 0.0 || t[4] != 0.0 || t[1] <= 0.0 || t[5] >= 0.0)
      throw InputError(format("the raster '{}' is not north up; warp it first, or give low_left and size",
                              source.file.path));
    if (frame.transform_from(raster.projection, source.file.path))
      throw InputError(
          format("the raster '{}' is in '{}', the scene in '{}'; warp it first (gdalwarp -t_srs), or give "
                 "low_left and size",
                 source.file.path, io::MapReference(raster.projection).name(), frame.reference()->name()));
    grid.cell_width_m = t[1];
    grid.cell_height_m = -t[5];
    grid.west_m = t[0];
    grid.north_m = t[3];
  } else {
    throw InputError(format("the raster '{}' has no georeference; give low_left and size", source.file.path));
  }
  grid.west_m -= frame.offset_m().x;
  grid.north_m -= frame.offset_m().y;
  return grid;
}

std::string key_of(const io::RasterDocument& source, const std::string& more) {
  std::string key = format("{}|{}|{}", source.file.path, static_cast<int>(source.tiling), more);
  if (source.by_texture) key += format("|{},{}", source.copies[0], source.copies[1]);
  if (source.placement)
    key += format("|{},{},{},{}", source.placement->x_m, source.placement->y_m, source.placement->width_m,
                  source.placement->height_m);
  return key;
}

const io::Raster& RasterStore::read(const std::string& path) {
  std::unique_ptr<const io::Raster>& raster = rasters_[path];
  if (!raster) raster = std::make_unique<const io::Raster>(io::read_raster(path));
  return *raster;
}

std::span<const float> band_of(const io::Raster& raster, int band, const std::string& path) {
  if (band < 1 || band > raster.bands)
    throw InputError(format("the raster '{}' has no band {}; it has {}", path, band, raster.bands));
  const std::size_t cells = raster.cells();
  return {raster.values.data() + static_cast<std::size_t>(band - 1) * cells, cells};
}

}  // namespace ifov::session
