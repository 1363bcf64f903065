#include "io/mesh/file_bytes.h"

#include <fstream>
#include <iterator>

#include "core/error.h"

namespace ifov::io {

std::string read_file_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw EnvironmentError(format("cannot read '{}': no such file", path.string()));
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!stream) throw EnvironmentError(format("cannot read '{}'", path.string()));
  return bytes;
}

}  // namespace ifov::io
