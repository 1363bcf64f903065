#include "studies/common/study_files.h"

#include <system_error>

#include "core/error.h"
#include "core/format.h"
#include "io/files/own_files.h"

namespace ifov::studies {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw SystemError(format("cannot make the folder '{}': {}", folder.string(), error.message()));
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  io::write_new_file(path, content);
}

}  // namespace ifov::studies
