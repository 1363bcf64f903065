#include <algorithm>
#include <array>
#include <cctype>

#include "io/mesh/gltf_reader.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/ply_reader.h"

namespace ifov::io {
namespace {

constexpr std::array kFormats{&kObj, &kPly, &kGltf};

}  // namespace

std::span<const MeshFormat* const> mesh_formats() { return kFormats; }

const MeshFormat* mesh_format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const MeshFormat* format : kFormats)
    if (std::find(format->extensions.begin(), format->extensions.end(), extension) !=
        format->extensions.end())
      return format;
  return nullptr;
}

}  // namespace ifov::io
