#include "session/assembly/surfaces/texture_assembly.h"

#include <algorithm>
#include <filesystem>

#include "core/overloaded.h"
#include "io/document/opacity_document.h"
#include "materials/opacity_map.h"
#include "materials/relief_map.h"
#include "materials/texture_map.h"
#include "sampling/hash.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

materials::MapGrid TextureAssembly::grid(const io::RasterDocument& source, const io::Raster& raster) {
  const materials::MapGrid grid = grid_of(source, raster, frame_);
  if (grid.by == materials::MapBy::position) {
    const MapScale scale{source.file.path,
                         grid.cell_width_m,
                         grid.cell_height_m,
                         grid.west_m,
                         grid.north_m,
                         grid.width * grid.cell_width_m,
                         grid.height * grid.cell_height_m,
                         grid.tiling != materials::Tiling::edge};
    if (std::find(scales_.begin(), scales_.end(), scale) == scales_.end()) scales_.push_back(scale);
  }
  return grid;
}

struct TextureAssembly::Image {
  materials::TextureMap::Image map;
};

TextureAssembly::Image TextureAssembly::image(const io::TextureImage& source, const std::string& material) {
  return with_position(sources_, source.raster.file.position, [&] {
    const io::Raster& raster = read(source.raster);
    const std::string& path = source.raster.file.path;
    materials::ImageScores scores;
    try {
      scores = materials::score_image(band_of(raster, source.band, path), raster.nodata);
    } catch (const InputError& error) {
      throw InputError(format("'{}': {}", path, error.what()));
    }
    if (log_ != nullptr) {
      const std::string name = std::filesystem::path(path).filename().string();
      const auto warn_clipped = [&](double share, double number) {
        if (share > 0.0)
          log_->warn(format(
              "texture '{}' of material '{}': {:.1f} % of the cells hold the number {:g} at the end of the "
              "histogram, which looks clipped; they all take the same curve",
              name, material, 100.0 * share, number));
      };
      warn_clipped(scores.clipped_low, scores.lowest);
      warn_clipped(scores.clipped_high, scores.highest);
      if (scores.unknown > 0)
        log_->warn(format("texture '{}' of material '{}': {} cells hold no number and take the mean", name,
                          material, scores.unknown));
    }
    return Image{{grid(source.raster, raster), std::move(scores.scores)}};
  });
}

std::shared_ptr<const materials::TextureMap> TextureAssembly::texture(
    std::size_t material, const std::vector<radiometry::Spectrum>& curves) {
  std::shared_ptr<const materials::TextureMap>& shared = textures_[material];
  if (shared) return shared;
  const io::MaterialDocument& source = written_[material];
  std::vector<materials::SpectralRange> ranges;
  std::vector<materials::TextureMap::Image> images;
  for (const io::TextureImage& one : source.texture->images) {
    ranges.push_back({one.from_um, one.to_um});
    images.push_back(image(one, source.name).map);
  }
  with_position(sources_, source.texture->position, [&] {
    const auto distance = source.texture->covariance ? materials::CurveMatcher::Distance::covariance
                                                     : materials::CurveMatcher::Distance::plain;
    materials::CurveMatcher matcher(materials::range_means(curves, ranges), ranges.size(), distance);
    shared = std::make_shared<materials::TextureMap>(std::move(images), std::move(matcher),
                                                     sampling::hash(seed_, material));
  });
  return shared;
}

std::shared_ptr<const materials::ReliefMap> TextureAssembly::read_relief(const io::ReliefDocument& source) {
  const auto from_heights = [&](const io::HeightRelief& heights) {
    const io::Raster& raster = read(heights.raster);
    const std::span<const float> numbers = band_of(raster, 1, heights.raster.file.path);
    std::vector<float> height_m;
    for (const float number : numbers)
      height_m.push_back(static_cast<float>(heights.unit_m * static_cast<double>(number)));
    return std::make_shared<materials::ReliefMap>(
        materials::ReliefMap::from_heights(grid(heights.raster, raster), height_m));
  };
  const auto from_normals = [&](const io::NormalRelief& normals) {
    const io::Raster& raster = read(normals.raster);
    std::vector<float> numbers;
    for (int band = 1; band <= 3; ++band)
      for (const float number : band_of(raster, band, normals.raster.file.path))
        numbers.push_back(static_cast<float>(normals.factor * static_cast<double>(number) + normals.offset));
    return std::make_shared<materials::ReliefMap>(
        materials::ReliefMap::from_normals(grid(normals.raster, raster), numbers));
  };
  return std::visit(Overloaded{from_heights, from_normals}, source.value);
}

std::shared_ptr<const materials::ReliefMap> TextureAssembly::relief(std::size_t material) {
  std::shared_ptr<const materials::ReliefMap>& shared = reliefs_[material];
  const io::ReliefDocument& source = *written_[material].relief;
  if (!shared) with_position(sources_, source.position, [&] { shared = read_relief(source); });
  return shared;
}

std::shared_ptr<const materials::OpacityMap> TextureAssembly::holes(std::size_t material) {
  const std::shared_ptr<const io::OpacityDocument>& source = written_[material].opacity;
  if (!source) return nullptr;
  std::shared_ptr<const materials::OpacityMap>& shared = holes_[material];
  if (shared) return shared;
  with_position(sources_, source->raster.file.position, [&] {
    const io::Raster& raster = read(source->raster);
    std::vector<bool> open;
    for (const float number : band_of(raster, source->band, source->raster.file.path))
      open.push_back((raster.nodata && number == static_cast<float>(*raster.nodata)) ||
                     !(static_cast<double>(number) >= source->cutoff));
    shared = std::make_shared<const materials::OpacityMap>(grid(source->raster, raster), std::move(open));
  });
  const double share = shared->open_share();
  if (log_ != nullptr && (share == 0.0 || share == 1.0))
    log_->warn(format("opacity map '{}' of material '{}': {} of its cells is below {:g}, so that {}",
                      std::filesystem::path(source->raster.file.path).filename().string(),
                      written_[material].name, share == 0.0 ? "none" : "each", source->cutoff,
                      share == 0.0 ? "it has no holes" : "nothing of it is there"));
  return shared;
}

}  // namespace ifov::session
