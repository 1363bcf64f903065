#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::io {

/// What becomes of the images of a file.
enum class GltfImages {
  left_out,   ///< a warning says so
  elsewhere,  ///< without one
  kept,  ///< Image::image has the bytes of those in data URIs; others are where they were: in buffers, in files
};

/// Parses a glTF 2 file (.gltf with buffers beside it or inline, .glb). Images are not read; buffers must lie
/// in the file's own folder or below. What the file leaves unread is told to `log` (may be null). Throws
/// InputError with the place of wrong JSON, SystemError if the file cannot be read.
tinygltf::Model load_gltf(const std::filesystem::path& path, LogSink* log,
                          GltfImages images = GltfImages::left_out);

/// As the library decodes names of files: %20 and a plus are blanks.
std::string decoded_uri(const std::string& uri);

/// The files of its buffers; none where load_gltf() refuses one of them.
std::vector<std::filesystem::path> gltf_buffers(const std::filesystem::path& path);

/// The files that its images name, decoded; none where the file is broken.
std::vector<std::string> gltf_image_uris(const std::filesystem::path& path);

}  // namespace ifov::io
