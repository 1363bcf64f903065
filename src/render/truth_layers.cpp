#include "render/truth_layers.h"

#include <vector>

#include "geometry/world.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "truth/collector.h"

namespace ifov::render {
namespace {

/// From pixel `first` on.
template <class Value>
void collect_into(truth::Collector::Collect<Value> collect, const truth::MiddleRays& rays, std::size_t first,
                  sampling::TileLayer& layer) {
  collect(rays, {reinterpret_cast<Value*>(layer.bytes.data()) + first * layer.bands,
                 rays.rays.size() * layer.bands});
}

}  // namespace

sampling::TileLayer empty_layer(const truth::Collector& collector, std::size_t pixels) {
  const std::size_t value_bytes = std::visit(
      []<class Value>(truth::Collector::Collect<Value>) { return sizeof(Value); }, collector.collect);
  const auto bands = static_cast<std::size_t>(collector.bands);
  return {std::string(collector.name), static_cast<std::uint32_t>(value_bytes),
          static_cast<std::uint32_t>(bands), std::vector<std::byte>(pixels * bands * value_bytes)};
}

void add_truth_layers(std::span<const truth::Collector* const> collectors, const scene::Scene& scene,
                      const sensor::Camera& camera, sampling::TileResult& tile) {
  if (collectors.empty()) return;
  const std::size_t before = tile.layers.size();
  for (const truth::Collector* collector : collectors)
    tile.layers.push_back(empty_layer(*collector, static_cast<std::size_t>(tile.tile.count())));
  const auto width = static_cast<std::size_t>(tile.tile.width());
  std::vector<sampling::FocalPoint> points(width);
  std::vector<math::Ray> rays(width);
  std::vector<geometry::SurfacePoint> hits(width);
  std::vector<scene::ResolvedSurface> surfaces(width);
  const scene::TruthMaterials materials = scene::truth_materials(scene);
  for (int y = tile.tile.y0; y < tile.tile.y1; ++y) {
    for (std::size_t x = 0; x < width; ++x)
      points[x] = {tile.tile.x0 + static_cast<double>(x) + 0.5, y + 0.5};
    camera.rays(points, rays);
    scene.world->intersect(rays, hits);
    for (std::size_t x = 0; x < width; ++x)
      if (hits[x].hit()) surfaces[x] = scene.resolve_without_temperature(hits[x]);
    const truth::MiddleRays middles{scene, rays, hits, surfaces, points, &camera, materials.of_material};
    const std::size_t first = static_cast<std::size_t>(y - tile.tile.y0) * width;
    for (std::size_t k = 0; k < collectors.size(); ++k)
      std::visit([&](auto collect) { collect_into(collect, middles, first, tile.layers[before + k]); },
                 collectors[k]->collect);
  }
}

}  // namespace ifov::render
