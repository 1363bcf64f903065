// Good files that the program itself writes, and small rasters as GDAL 3.6 wrote them (tests/fuzz/rasters).
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/seeds.h"
#include "geometry/body_record.h"
#include "io/files/input_file.h"
#include "io/instances/instance_writer.h"
#include "io/scene_cache/scene_cache.h"

namespace ifov::fuzz {
namespace {

namespace fs = std::filesystem;

/// What `write` puts into the file that it is given.
std::string bytes_written(const std::string& name, const std::function<void(const fs::path&)>& write) {
  const fs::path folder = fs::temp_directory_path() / ("ifov_fuzz_seed_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  write(folder / name);
  const std::string bytes = io::read_input(folder / name);
  fs::remove_all(folder);
  return bytes;
}

std::string raster_file(const char* name) {
  return io::read_input(std::string(IFOV_SOURCE_DIR "/tests/fuzz/rasters/") + name);
}

}  // namespace

std::vector<std::string> instance_file_seeds() {
  using Layout = io::InstanceLayout;
  std::vector<std::string> seeds;
  for (const Layout layout :
       {Layout{Layout::Position::float64, Layout::Rotation::quaternion, Layout::Scale::by_axis},
        Layout{Layout::Position::float32, Layout::Rotation::yaw_pitch_roll, Layout::Scale::uniform},
        Layout{Layout::Position::float32, Layout::Rotation::none, Layout::Scale::none}})
    seeds.push_back(bytes_written("a.ifovinst", [&layout](const fs::path& path) {
      io::InstanceWriter writer(path, layout, {500'000.0, 0.0, 0.0});
      for (int k = 0; k < 3; ++k) {
        io::Instance instance;
        instance.position_m = {500'000.0 + k, 1.0, 2.0};
        writer.add(instance);
      }
      writer.finish();
    }));
  return seeds;
}

std::vector<std::string> body_record_seeds() {
  geometry::TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  geometry::Body body = geometry::body_of(std::move(mesh));
  const auto bytes_of = [&body] {
    const geometry::BodyRecord record = geometry::record_of(body);
    std::string bytes = record.head;
    for (const auto& list : record.lists)
      bytes.append(reinterpret_cast<const char*>(list.data()), list.size());
    return bytes;
  };
  const std::string plain = bytes_of();
  const std::vector<std::uint32_t> order{1, 0};
  const std::vector<geometry::MeshChunk> chunks{{body.bounds, 0, 1}, {body.bounds, 1, 1}};
  body.mesh.order = order, body.mesh.chunks = chunks;
  return {plain, bytes_of()};
}

std::vector<std::string> scene_cache_seeds() {
  return {bytes_written("a.cache", [](const fs::path& path) {
    io::SceneCache cache(path, "version", nullptr);
    const std::string bytes(200, 'x');
    const std::span<const std::byte> piece = std::as_bytes(std::span(bytes));
    io::FileStamp stamp;
    stamp.path = "somewhere/a.ply";
    cache.put("mesh a.ply", {}, std::span(&piece, 1));
    cache.put("mesh b.ply", {stamp, stamp}, std::span(&piece, 1));
    cache.save();
  })};
}

std::vector<std::string> geotiff_seeds() {
  return {raster_file("a.tif"), raster_file("b.tif"), raster_file("c.tif"), raster_file("d.tif")};
}

std::vector<std::string> raster_seeds() {
  std::vector<std::string> seeds;
  for (const char* name : {"a.asc", "a.bmp", "a.img", "a.jpg", "a.pgm", "a.png", "a.grd", "b.grd", "c.grd"})
    seeds.push_back(raster_file(name));
  return seeds;
}

}  // namespace ifov::fuzz
