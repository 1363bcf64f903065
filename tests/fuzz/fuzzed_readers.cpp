#include "fuzz/fuzzed_readers.h"

#include <fstream>

#include "fuzz/seeds.h"
#include "io/city/city_json_reader.h"
#include "io/document/document.h"
#include "io/instances/instance_csv.h"
#include "io/mesh/gltf_reader.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/ply_reader.h"
#include "io/raster/raster.h"
#include "io/spectra/channel_table.h"
#include "io/spectra/csv_spectrum.h"
#include "io/spectra/ecostress.h"

namespace ifov::fuzz {
namespace {

/// The header is what is damaged; its data stand beside it.
void read_envi(const std::filesystem::path& header) {
  std::filesystem::path data = header;
  data.replace_extension(".img");
  if (!std::filesystem::exists(data)) std::ofstream(data, std::ios::binary) << std::string(4096, '\x3e');
  io::read_raster(data, 1u << 20);
}

}  // namespace

std::vector<FuzzedReader> fuzzed_readers() {
  return {
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
  };
}

}  // namespace ifov::fuzz
