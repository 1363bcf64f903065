#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "geometry/world.h"
#include "materials/bsdf/node_bsdf.h"
#include "radiometry/spectrum_block.h"
#include "render/truth_layers.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

/// Of a surface towards `outgoing`, into row 0 of three.
void emissivity_of(const transport::SpectralScene& scene, const scene::ResolvedSurface& surface,
                   math::Vec3 outgoing, radiometry::SpectrumBlock& rows) {
  float *sum = rows.row(0), *of_model = rows.row(1), *work = rows.row(2);
  std::fill_n(sum, rows.stride(), 0.0f);
  const double cosine = std::abs(math::dot(surface.shading_normal, outgoing));
  for (const scene::Constituent& part : surface) {
    const float* own = scene.materials().emissivity(part.material);
    if (const materials::NodeBsdf* const model = scene.materials().directional(part.material)) {
      model->emissivity(cosine, of_model, work);
      own = of_model;
    }
    const float weight = static_cast<float>(part.weight);
    for (std::size_t n = 0; n < rows.stride(); ++n) sum[n] += weight * own[n];
  }
}

}  // namespace

void add_empty_emissivity_layer(std::size_t channels, sampling::TileResult& tile) {
  const auto pixels = static_cast<std::size_t>(tile.tile.count());
  tile.layers.push_back({kEmissivityLayer, sizeof(float), static_cast<std::uint32_t>(channels),
                         std::vector<std::byte>(pixels * channels * sizeof(float))});
}

void add_emissivity_layer(const transport::SpectralScene& scene, const sensor::Camera& camera,
                          sampling::TileResult& tile) {
  const radiometry::SpectralNodes& nodes = scene.nodes();
  const std::size_t channels = nodes.channel_count(), width = static_cast<std::size_t>(tile.tile.width());
  radiometry::SpectrumBlock rows(3, nodes.node_count());
  // What channels make of 1 in all nodes is not quite 1.
  std::vector<float> of_one(channels), of_pixel(channels);
  std::fill_n(rows.row(0), rows.stride(), 1.0f);
  nodes.to_channels(rows.row(0), of_one.data());

  add_empty_emissivity_layer(channels, tile);
  std::byte* into = tile.layers.back().bytes.data();
  std::vector<sampling::FocalPoint> points(width);
  std::vector<math::Ray> rays(width);
  std::vector<geometry::SurfacePoint> hits(width);
  for (int y = tile.tile.y0; y < tile.tile.y1; ++y) {
    for (std::size_t x = 0; x < width; ++x)
      points[x] = {tile.tile.x0 + static_cast<double>(x) + 0.5, y + 0.5};
    camera.rays(points, rays);
    scene.scene().world->intersect(rays, hits);
    for (std::size_t x = 0; x < width; ++x, into += channels * sizeof(float)) {
      if (hits[x].hit()) {
        emissivity_of(scene, scene.scene().resolve_without_temperature(hits[x]), -rays[x].direction, rows);
        nodes.to_channels(rows.row(0), of_pixel.data());
        for (std::size_t c = 0; c < channels; ++c) of_pixel[c] /= of_one[c];
      } else {
        std::fill(of_pixel.begin(), of_pixel.end(), std::numeric_limits<float>::quiet_NaN());
      }
      std::memcpy(into, of_pixel.data(), channels * sizeof(float));
    }
  }
}

}  // namespace ifov::render
