#include "io/spectra/spectrum_bytes.h"

#include <fstream>
#include <iterator>

#include "core/error.h"

namespace ifov::io {

std::string read_bytes(const std::filesystem::path& path, std::uintmax_t most) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw EnvironmentError(format("cannot read '{}': no such file", path.string()));
  if (std::filesystem::file_size(path, error) > most)
    throw InputError(format("{}: a spectrum of more than {} MiB is not read", path.string(), most >> 20),
                     {path.string(), 0, 0});
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!stream) throw EnvironmentError(format("cannot read '{}'", path.string()));
  return bytes;
}

}  // namespace ifov::io
