#include "io/spectra/spectrum_bytes.h"

#include "core/error.h"
#include "io/files/input_file.h"

namespace ifov::io {

std::string read_bytes(const std::filesystem::path& path, std::uintmax_t most) {
  const InputFile file(path);
  if (file.size() > most)
    throw InputError(format("{}: a spectrum of more than {} MiB is not read", path.string(), most >> 20),
                     {path.string(), 0, 0});
  return file.text();
}

}  // namespace ifov::io
