#pragma once

#include <filesystem>
#include <string>

namespace ifov::io {

/// Makes GDAL ready, once: the drivers that ifov uses and no others, none from plug-ins, no network. A driver that is
/// to read or write something new is added to the list in gdal_setup.cpp.
void prepare_gdal();

/// The name by which GDAL opens an input file. GDAL then reads it, and all files that it finds beside it or named in it,
/// through InputFile: plain files only, where --inputs-below allows them, and never for writing.
std::string gdal_input_name(const std::filesystem::path& path);

/// A message of GDAL about such a file, with the file's own name.
std::string without_input_prefix(std::string message);

/// While it lives, GDAL writes no .aux.xml beside what this thread writes.
class NoSidecars {
 public:
  NoSidecars();
  ~NoSidecars();
  NoSidecars(const NoSidecars&) = delete;
  NoSidecars& operator=(const NoSidecars&) = delete;
};

}  // namespace ifov::io
