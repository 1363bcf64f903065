#include "fuzz/fuzzed_readers.h"

#include <cstddef>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fuzz/seeds.h"
#include "geometry/body_record.h"
#include "io/city/city_json_reader.h"
#include "io/document/document.h"
#include "io/files/input_file.h"
#include "io/instances/instance_csv.h"
#include "io/instances/instance_file.h"
#include "io/mesh/gltf_reader.h"
#include "io/mesh/mesh_materials.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/ply_reader.h"
#include "io/products/envi_reader.h"
#include "io/raster/elevation.h"
#include "io/raster/raster.h"
#include "io/scene_cache/cache_writer.h"
#include "io/scene_cache/scene_cache.h"
#include "io/spectra/asd.h"
#include "io/spectra/brdf_table.h"
#include "io/spectra/channel_table.h"
#include "io/spectra/csv_spectrum.h"
#include "io/spectra/ecostress.h"
#include "io/spectra/ems.h"
#include "io/spectra/envi_library.h"
#include "io/spectra/usgs.h"
#include "support/small_pictures.h"

namespace ifov::fuzz {
namespace {

/// The header is what is damaged; its data stand beside it.
void read_envi(const std::filesystem::path& header) {
  std::filesystem::path data = header;
  data.replace_extension(".img");
  if (!std::filesystem::exists(data)) std::ofstream(data, std::ios::binary) << std::string(4096, '\x3e');
  io::read_raster(data, 1u << 20);
}

/// The same of a spectral library of two spectra.
void read_sli(const std::filesystem::path& header) {
  std::filesystem::path data = header;
  data.replace_extension(".sli");
  if (!std::filesystem::exists(data)) std::ofstream(data, std::ios::binary) << std::string(24, '\x3e');
  io::read_envi_library(header);
}

/// Values without wavelengths, which stand in a file of their own.
void read_usgs_column(const std::filesystem::path& column) {
  const io::TextFile wavelengths("wavelengths.txt", "wavelengths\n0.35\n0.36\n0.37\n");
  io::parse_usgs(io::TextFile(column), wavelengths);
}

/// A product that is read again; its data stand beside the header.
void read_cube(const std::filesystem::path& header) {
  std::filesystem::path data = header;
  data.replace_extension(".img");
  if (!std::filesystem::exists(data)) std::ofstream(data, std::ios::binary) << std::string(4096, '\x3e');
  const io::EnviReader reader(data);
  std::vector<float> line(static_cast<std::size_t>(reader.header().samples));
  for (int band = 0; band < reader.header().bands; ++band) reader.read(reader.header().lines - 1, band, line);
}

/// Every copy of a list.
void read_instance_file(const std::filesystem::path& path) {
  const io::InstanceFile file(path);
  for (std::size_t k = 0; k < file.count(); ++k) file.at(k);
}

/// A record of a cache; one without sense is no error there.
void read_body_record(const std::filesystem::path& path) {
  const auto bytes = std::make_shared<const std::string>(io::read_input(path));
  if (!geometry::body_from_record(std::as_bytes(std::span(*bytes)), bytes)) throw InputError("no body");
}

/// Damage behind the hashes, which alone would keep it out.
void read_scene_cache(const std::filesystem::path& path) {
  std::string bytes = io::read_input(path);
  io::CacheHeader header;
  if (bytes.size() >= sizeof header) {
    std::memcpy(&header, bytes.data(), sizeof header);
    const auto all = std::as_bytes(std::span(bytes));
    header.content_hash = io::hash_of_blocks(all.subspan(sizeof header));
    std::memcpy(bytes.data(), &header, sizeof header);
    header.header_hash = io::cache_hash(all.first(offsetof(io::CacheHeader, header_hash)));
    std::memcpy(bytes.data(), &header, sizeof header);
    std::ofstream(path, std::ios::binary) << bytes;
  }
  struct Log final : LogSink {
    void info(const std::string& message) override { said += message; }
    void warn(const std::string& message) override { said += message; }
    std::string said;
  } log;
  io::SceneCache cache(path, "version", &log);
  for (const char* name : {"mesh a.ply", "mesh b.ply"})
    if (const auto record = cache.find(name)) {
      const std::string copy(reinterpret_cast<const char*>(record->data()), record->size());
      if (copy.size() > bytes.size()) throw std::logic_error("a record larger than its file");
    }
  if (log.said.find("is not used") != std::string::npos) throw InputError(log.said);
}

/// A glTF file with a picture of its own.
std::vector<std::string> gltf_material_seeds() {
  std::string text = gltf_seeds().front();
  const std::size_t end = text.rfind('}');
  const std::string picture(test::kPictureWithHole);
  text.insert(end, R"(,"images":[{"uri":"data:image/png;base64,)" + picture +
                       R"("}],"textures":[{"source":0}],"samplers":[{"wrapS":33071,"wrapT":33648}])");
  const std::string base =
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0],"rotation":1}}}})";
  const std::string key = "\"materials\":[{";
  const std::size_t at = text.find(key);
  if (at == std::string::npos)
    text.insert(text.rfind('}'), ",\"materials\":[{" + base + "}]");
  else
    text.insert(at + key.size(), base + (text[at + key.size()] == '}' ? "" : ","));
  return {text};
}

}  // namespace

std::vector<FuzzedReader> fuzzed_readers() {
  std::vector<FuzzedReader> readers = {
      {"obj",
       "a.obj",
       obj_seeds(),
       {"f ", "v ", "vt ", "usemtl ", "//", "\\\n", "-1 "},
       [](const auto& path) { io::read_obj(path); }},
      {"ply",
       "a.ply",
       ply_seeds(),
       {"element ", "property ", "list ", "uchar ", "double ", "end_header\n", "vertex_index\n", "face ",
        "big_endian"},
       [](const auto& path) { io::read_ply(path); }},
      {"gltf",
       "a.gltf",
       gltf_seeds(),
       {"\"byteStride\":", "\"sparse\":{", "\"children\":[0]", "\"extras\":", "[[", "\"normalized\":true",
        "\"mode\":5"},
       [](const auto& path) { io::read_gltf(path); }},
      {"gltf_materials",
       "a.gltf",
       gltf_material_seeds(),
       {"\"KHR_texture_transform\":{", "\"texCoord\":1", "\"bufferView\":0", "\"sampler\":0", "\"wrapS\":1",
        "\"alphaMode\":\"MASK\"", "[1,1,1,1]"},
       [](const auto& path) {
         io::read_mesh_materials(path);
         io::read_gltf(path, nullptr, io::MeshUse::with_materials);
       }},
      {"glb",
       "a.glb",
       glb_seeds(),
       {"\"byteStride\":", "\"images\":[{\"bufferView\":0}]", "\"children\":[0]", "JSON", "BIN"},
       [](const auto& path) { io::read_gltf(path); }},
      {"city_json",
       "a.city.json",
       city_json_seeds(),
       {"\"GeometryInstance\"", "\"parents\":[\"a\"]", "\"CompositeSolid\"", "[[", "]]", "null",
        "\"values\":"},
       [](const auto& path) { io::read_city_json(path); }},
      {"document",
       "a.json",
       document_seeds(),
       {"\"objects\":", " m\"", " um\"", "[[", "}}", "//", "/*", "\\ud800"},
       [](const auto& path) { io::read_document(path.string()); }},
      {"ecostress",
       "a.spectrum.txt",
       ecostress_seeds(),
       {"Units:", "percent", "wavenumber", "\n\n", "Number of X Values:"},
       [](const auto& path) { io::read_ecostress(path); }},
      {"spectrum_csv",
       "a.csv",
       table_seeds(),
       {",", ";", "\t", "\n\n", "nan"},
       [](const auto& path) { io::read_csv_spectrum(path); }},
      {"brdf_table",
       "a.csv",
       {"0 0 0 0.5 0.1\n0 0 180 0.5 0.1\n60 0 0 0.5 0.1\n60 0 180 0.5 0.2\n", "30, 30, 0, 0.5, 0.1\n"},
       {",", "\t", "\n\n", "nan", "90", "180"},
       [](const auto& path) { materials::BsdfTable(io::read_brdf_table(path), true); }},
      {"usgs",
       "a.asc",
       usgs_seeds(),
       {"-1.23e34", "\n\n", "nan", "  "},
       [](const auto& path) { io::read_usgs(path); }},
      {"usgs_column", "a.txt", usgs_column_seeds(), {"-1.23e34", "\n", "nan", " TRAN"}, read_usgs_column},
      {"asd",
       "a.asd",
       asd_seeds(),
       {"ASD", "as2", "as8", std::string(2, '\0'), "\xff\xff"},
       [](const auto& path) { io::read_asd(path); }},
      {"sli",
       "a.hdr",
       sli_header_seeds(),
       {"samples = ", "lines = ", "data type = ", "bbl = {1, 0, 1}\n", "spectra names = ", "{", "}",
        "header offset = ", "reflectance scale factor = "},
       read_sli},
      {"ems",
       "a.ems",
       ems_seeds(),
       {"CURVE_BEGIN", "1.0\n", "\n\n", "39850 "},
       [](const auto& path) { io::read_ems(path); }},
      {"channels",
       "a.txt",
       channel_seeds(),
       {"BAND ", "fwhm", ";;", ",,"},
       [](const auto& path) { io::read_channels(path); }},
      {"instance_csv",
       "a.csv",
       {"x y z yaw scale\n1 2 3 90 1.5\n4 5 6 0 1\n"},
       {",", "\n", "#"},
       [](const auto& path) { io::read_instance_csv(path); }},
      {"envi",
       "a.hdr",
       envi_header_seeds(),
       {"samples = ", "data type = ", "header offset = ", "interleave = ", "{", "}",
        "map info = ", "file compression = 1\n"},
       read_envi},
      {"cube",
       "a.img.hdr",
       envi_header_seeds(),
       {"samples = ", "data type = ", "header offset = ", "interleave = ", "{", "}", "byte order = 1\n"},
       read_cube},
      {"geotiff",
       "a.tif",
       geotiff_seeds(),
       {std::string("\0\0", 2), "\xff\xff", "II*", "MM"},
       [](const auto& path) { io::read_raster(path, 1u << 20); }},
      {"raster",
       "a.raster",
       raster_seeds(),
       {std::string("\0\0", 2), "\xff\xff", "ncols ", "DSAA", "IHDR", "nan"},
       [](const auto& path) { io::read_raster(path, 1u << 20); }},
      {"elevation",
       "a.asc",
       raster_seeds(),
       {"-9999 ", "nan ", "nodata_value 0\n", "1e308 "},
       [](const auto& path) { io::read_elevation(path, 1, std::nullopt, io::UnknownHeights::fill); }},
      {"instance_file",
       "a.ifovinst",
       instance_file_seeds(),
       {"\xff\xff", std::string(4, '\0')},
       read_instance_file},
      {"body_record", "a.record", body_record_seeds(), {"\xff\xff", std::string(8, '\0')}, read_body_record},
      {"scene_cache", "a.cache", scene_cache_seeds(), {"\xff\xff", std::string(8, '\0')}, read_scene_cache},
  };
  for (FuzzedReader& reader : atmosphere_readers()) readers.push_back(std::move(reader));
  return readers;
}

}  // namespace ifov::fuzz
