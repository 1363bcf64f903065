#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::io {

/// Parses a glTF 2 file (.gltf with buffers beside it or inline, .glb). Images are not read; buffers must lie
/// in the file's own folder or below. What the file leaves unread is told to `log` (may be null). Throws
/// InputError with the place of wrong JSON, SystemError if the file cannot be read.
tinygltf::Model load_gltf(const std::filesystem::path& path, LogSink* log);

/// The files of its buffers; none where load_gltf() refuses one of them.
std::vector<std::filesystem::path> gltf_buffers(const std::filesystem::path& path);

}  // namespace ifov::io
