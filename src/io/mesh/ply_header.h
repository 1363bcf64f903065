#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyEncoding { ascii, little_endian, big_endian };

std::size_t size_of(PlyType type);  ///< bytes in a binary file

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< of a list: the type of its count
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  const PlyProperty* find(std::string_view property) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t data_begin = 0;  ///< offset of the first byte after the header
  int lines = 0;               ///< lines of the header
  /// Of `comment TextureFile NAME`, as scanners' programs write it: the picture that texture coordinates are of.
  struct TextureFile {
    std::string name;
    int line = 0, column = 0;
  };
  std::vector<TextureFile> textures;
};

/// Reads the header of a PLY file (Turk, "The PLY Polygon File Format", 1994) and checks that the rows it
/// announces can fit into the file. Lines end with \n, \r\n or \r, as the first one does. Throws InputError
/// with file, line and column; `name` is the file's.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace ifov::io
