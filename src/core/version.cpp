#include "core/version.h"

#include <elf.h>
#include <gnu/libc-version.h>
#include <link.h>

#include <cstddef>
#include <cstring>

#include "core/format.h"

namespace ifov {
namespace {

constexpr std::size_t kShownBytes = 8;

/// The build id in a segment of notes (ELF-64 object file format, "Note Section"), as hexadecimal digits.
std::string id_in_notes(const char* note, std::size_t bytes) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  while (bytes >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) header;
    std::memcpy(&header, note, sizeof header);
    const std::size_t size = sizeof header + padded(header.n_namesz) + padded(header.n_descsz);
    if (size > bytes) break;
    if (header.n_type == NT_GNU_BUILD_ID) {
      std::string id;
      const char* from = note + sizeof header + padded(header.n_namesz);
      for (std::size_t k = 0; k < header.n_descsz && k < kShownBytes; ++k)
        id += format("{:02x}", static_cast<unsigned char>(from[k]));
      return id;
    }
    note += size;
    bytes -= size;
  }
  return {};
}

/// Whether an address lies in what was loaded of an object.
bool holds(const dl_phdr_info& info, ElfW(Addr) address) {
  for (int k = 0; k < info.dlpi_phnum; ++k) {
    const ElfW(Phdr)& segment = info.dlpi_phdr[k];
    const ElfW(Addr) begin = info.dlpi_addr + segment.p_vaddr;
    if (segment.p_type == PT_LOAD && address >= begin && address - begin < segment.p_memsz) return true;
  }
  return false;
}

/// Looks for the object that holds this very function: the program, or libifov in somebody else's.
int visit_object(dl_phdr_info* info, std::size_t, void* result) {
  if (!holds(*info, reinterpret_cast<ElfW(Addr)>(&visit_object))) return 0;
  std::string& id = *static_cast<std::string*>(result);
  for (int k = 0; k < info->dlpi_phnum && id.empty(); ++k)
    if (info->dlpi_phdr[k].p_type == PT_NOTE)
      id = id_in_notes(reinterpret_cast<const char*>(info->dlpi_addr + info->dlpi_phdr[k].p_vaddr),
                       info->dlpi_phdr[k].p_memsz);
  return 1;
}

}  // namespace

std::string version() { return IFOV_VERSION; }

std::string build_id() {
  std::string id;
  dl_iterate_phdr(visit_object, &id);
  return format("{} (glibc {})", id.empty() ? "unknown" : id, gnu_get_libc_version());
}

std::string instruction_set() {
  // The levels' names are known to some compilers alone; these features came with them.
  __builtin_cpu_init();
  const bool third = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                     __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool fourth = third && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  return fourth ? "x86-64-v4" : third ? "x86-64-v3" : "x86-64";
}

}  // namespace ifov
