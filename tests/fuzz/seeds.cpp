#include "fuzz/seeds.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "io/files/input_file.h"

namespace ifov::fuzz {
namespace {

template <class T>
void put(std::string& bytes, T value, bool big = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// A triangle: positions, texture coordinates, indices; 36 + 24 + 6 bytes and padding.
std::string gltf_buffer() {
  std::string bytes;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f})
    put(bytes, value);
  for (const int index : {0, 1, 2, 0}) put(bytes, static_cast<std::uint16_t>(index));
  return bytes;
}

std::string gltf_json(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2]}],"nodes":[{"mesh":0,"children":[1],
"translation":[1,2,3]},{"mesh":0,"rotation":[0,0,0.7071,0.7071],"scale":[1,2,-1]},{"mesh":0,
"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},
"indices":2,"material":0,"mode":4}]}],"materials":[{"name":"tile"}],"buffers":[{)" +
         uri +
         R"("byteLength":68}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,
"byteLength":24},{"buffer":0,"byteOffset":60,"byteLength":6}],"accessors":[{"bufferView":0,"componentType":5126,
"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},{"bufferView":2,
"componentType":5123,"count":3,"type":"SCALAR"}]})";
}

}  // namespace

std::vector<std::string> obj_seeds() {
  return {
      "# a comment\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0 1.0\nv 0 1e0 0 .5 .5 .5\nvt 0 0\nvt 1 0\nvt 1 "
      "1\nvn 0 0 1\n"
      "f 1 2 3\nusemtl two words\nf 1/1/1 2/2/1 \\\n  3/3/1 -1/-1/-1\no part\ng group\ns off\nf 1//1 3//1 "
      "4//1\nl 1 2\n",
      "v 0 0 0\r\nv 2 0 0\r\nv 2 2 0\r\nv 1 1 0\r\nv 0 2 0\r\nf 1 2 3 4 5\r\nf 1 2 3 1 2 3\r\n"};
}

std::vector<std::string> ply_seeds() {
  const std::string elements =
      "comment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty uchar red\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float "
      "texcoord\nend_header\n";
  std::vector<std::string> seeds = {
      "ply\nformat ascii 1.0\n" + elements +
      "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0 4\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n3 0 1 2 0\n"};
  for (const bool big : {false, true}) {
    std::string binary =
        std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + elements;
    for (int k = 0; k < 4; ++k) {
      for (const float value : {k % 2 == 0 ? 0.f : 1.f, k < 2 ? 0.f : 1.f, 0.f}) put(binary, value, big);
      put(binary, static_cast<std::uint8_t>(k));
    }
    for (int face = 0; face < 2; ++face) {
      put(binary, static_cast<std::uint8_t>(3));
      for (const std::int32_t i : {0, 1, 2 + face}) put(binary, i, big);
      put(binary, static_cast<std::uint8_t>(0));
    }
    seeds.push_back(binary);
  }
  seeds.push_back(
      "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty double x\r\nproperty double y\r\nproperty "
      "double z\r\n"
      "property float s\r\nproperty float t\r\nelement tristrips 1\r\nproperty list int int "
      "vertex_indices\r\n"
      "end_header\r\n0 0 0 0 0\r\n1 0 0 1 0\r\n0 1 0 0 1\r\n5 0 1 2 -1 0\r\n");
  return seeds;
}

std::vector<std::string> gltf_seeds() {
  return {gltf_json(
      R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AAABAAIAAAA=",)")};
}

std::vector<std::string> glb_seeds() {
  std::string json = gltf_json("");
  while (json.size() % 4 != 0) json += ' ';
  const std::string buffer = gltf_buffer();
  std::string bytes = "glTF";
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(28 + json.size() + buffer.size()));
  put(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  put(bytes, static_cast<std::uint32_t>(buffer.size()));
  bytes += std::string("BIN\0", 4) + buffer;
  return {bytes};
}

std::vector<std::string> city_json_seeds() {
  return {
      R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"},
"transform":{"scale":[0.001,0.001,0.001],"translate":[84616.468,447422.999,-0.452]},
"vertices":[[0,0,0],[9000,0,0],[9000,9000,0],[0,9000,0],[2000,2000,0],[4000,2000,0],[4000,4000,0],[0,0,5000],[9000,0,5000],[9000,9000,5000]],
"geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]]},
"CityObjects":{
"a":{"type":"Building","children":["b"],"attributes":{"year":1900,"use":"church","old":true}},
"b":{"type":"BuildingPart","parents":["a"],"geometry":[{"type":"Solid","lod":"2.2","boundaries":[[[[0,1,2,3],[4,5,6]],[[7,8,9]],[[0,1,8,7]]]],
"semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface"}],"values":[[0,1,null]]}},
{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]},
"c":{"type":"Road","geometry":[{"type":"MultiSurface","lod":1,"boundaries":[[[0,2,1,3]]]}]},
"d":{"type":"SolitaryVegetationObject","geometry":[{"type":"GeometryInstance","template":0,"boundaries":[3],
"transformationMatrix":[2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1]}]},
"e":{"type":"Bridge","geometry":[{"type":"MultiSolid","lod":"2","boundaries":[[[[[0,1,2]],[[7,8,9]]]]]}]}}})"};
}

std::vector<std::string> document_seeds() {
  return {
      io::read_input(IFOV_SOURCE_DIR "/examples/demo.json"),
      R"({"ifov": 1, "scene": {"origin": {"easting": "84616 m", "northing": "447422 m"}, "materials": {"a": {"reflectance": 0.5}},
"objects": [{"plane": {"height": "-1 m"}, "material": "a", "pilot_ray": false},
{"mesh": {"file": "a.ply", "up": "y", "unit": "cm"}, "material": "a", "transform": {"rotate": {"angle": "3 deg"}, "scale": [1, 2, 3]}}]},
"light": {"sky": {"radiance": "10 W m-2 sr-1 um-1"}}, "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 4]}},
"channels": [{"gaussian": {"center": "0.55 um", "fwhm": "20 nm"}}]}, "sampling": {"grid": {"elements": [2, 2]}}})"};
}

std::vector<std::string> ecostress_seeds() {
  return {
      "Name: Construction Concrete\nType: manmade\nClass: Concrete\nSubclass: Paving\nParticle Size: Solid\n"
      "Sample No.: 0092UUUCNC\nOwner: a\nWavelength Range: All\nOrigin: JHU\nCollection Date: N/A\n"
      "Description: Paving concrete, that\n goes on.\nMeasurement: Directional (10 Degree) Hemispherical "
      "Reflectance\n"
      "First Column: X\nSecond Column: Y\nX Units: Wavelength (micrometers)\nY Units: Reflectance (percent)\n"
      "First X Value: 0.42\nLast X Value: 14.0\nNumber of X Values: 4\nAdditional Information: none\n\n"
      "0.4200\t21.5\n0.5000\t22.25\n2.0000\t30.0\n14.0000\t5.125\n"};
}

std::vector<std::string> usgs_seeds() {
  return {
      "USGS Digital Spectral Library splib06a\n\nGrass GDS91 W1R1Ba AREF\ncopy of splib05a r 1439\n"
      "       0.205100      -1.23e34        0.010460\n       0.221100       0.015736       0.001491\n"
      "       0.229100       0.013988       0.001296\n"};
}

std::vector<std::string> usgs_column_seeds() {
  return {" splib07a Record=13: Grass ASDFRa AREF\n 0.1\n -1.23e34\n 0.3\n"};
}

/// Four channels from 350 nm on with a white reference, as numbers of each format.
std::vector<std::string> asd_seeds() {
  std::vector<std::string> seeds;
  for (const int format_code : {0, 1, 2}) {
    std::string bytes(484, '\0');
    const auto set = [&bytes](std::size_t offset, auto value) {
      std::memcpy(bytes.data() + offset, &value, sizeof value);
    };
    bytes.replace(0, 3, "as7");
    set(186, std::uint8_t{1});
    set(191, 350.f);
    set(195, 1.f);
    set(199, static_cast<std::uint8_t>(format_code));
    set(204, std::uint16_t{4});
    const auto numbers = [&](int first) {
      for (int k = first; k < first + 4; ++k) {
        if (format_code == 0) put(bytes, static_cast<float>(k));
        if (format_code == 1) put(bytes, static_cast<std::int32_t>(k));
        if (format_code == 2) put(bytes, static_cast<double>(k));
      }
    };
    numbers(1);
    put(bytes, std::uint16_t{0xffff});
    bytes += std::string(16, '\0');
    put(bytes, std::uint16_t{5});
    bytes += "white";
    numbers(6);
    seeds.push_back(bytes);
  }
  return seeds;
}

std::vector<std::string> sli_header_seeds() {
  return {
      "ENVI\nsamples = 3\nlines = 2\nbands = 1\nheader offset = 0\nfile type = ENVI Spectral Library\n"
      "data type = 4\ninterleave = bsq\nbyte order = 0\nwavelength units = Nanometers\nspectra names = {\n "
      "roof, \n "
      "lawn}\nwavelength = {400, 500,\n 600}\nreflectance scale factor = 10\n"};
}

std::vector<std::string> ems_seeds() {
  std::string weights;
  for (int degree = 0; degree <= 90; ++degree) weights += "1.0\n";
  return {"1\n" + weights + "CURVE_BEGIN\n0.35\t0.98\n2.5 0.95\n14.9\t0.9\n",
          "2\n" + weights + "0\n20000 0.5\n1000 0.9\n1\n20000 0.4\n1000 0.8\n"};
}

std::vector<std::string> table_seeds() {
  return {"# wavelength, value\nwavelength_um,reflectance\n0.4,0.1\n0.5,0.2\n0.7,0.35\n2.5,0.3\n",
          "; nm\n2500 3.0e-1\n700\t.35\n\n400 0.1\n"};
}

std::vector<std::string> channel_seeds() {
  return {";; BAND 1\n443 0.1\n444 1\n445 0.2\n;; BAND 2\n490 0\n500 1\n510 0\n",
          "wavelength,blue,green\n400,0,\n410,1,0\n420,0,1\n430,,0\n",
          "wavelength fwhm\n0.45 0.01\n0.55 0.02\n"};
}

std::vector<std::string> envi_header_seeds() {
  return {
      "ENVI\ndescription = {a cube}\nsamples = 4\nlines = 3\nbands = 2\nheader offset = 0\nfile type = ENVI "
      "Standard\n"
      "data type = 4\ninterleave = bil\nbyte order = 0\nwavelength units = Micrometers\nwavelength = {0.45, "
      "0.55}\n"
      "map info = {UTM, 1, 1, 500000, 5400000, 10, 10, 32, North, WGS-84}\ndata ignore value = -9999\n"
      "band names = {blue, green}\n"};
}

}  // namespace ifov::fuzz
