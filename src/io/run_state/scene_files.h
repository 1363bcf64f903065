#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/scene_cache/file_stamp.h"

namespace ifov::io {

/// The stamps of the files that a document names, and of those that their readers look at beside them
/// (headers and georeferences of rasters, buffers of glTF meshes), sorted by path; paths are relative to
/// `folder`, the document's. Assets have their names as paths and no time. Files of the size and time of one of `known` are not read. Throws SystemError where
/// one cannot be read.
std::vector<FileStamp> stamp_scene_files(const std::vector<std::string>& named,
                                         const std::filesystem::path& folder,
                                         std::span<const FileStamp> known = {});

}  // namespace ifov::io
