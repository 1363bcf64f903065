#include "io/files/file_reasons.h"

#include <cerrno>
#include <cstring>

namespace ifov::io {

std::string file_reason(int error) {
  switch (error) {
    case ENOENT: return "no such file";
    case EISDIR: return "it is a folder";
    case ENOTDIR: return "what its name takes for a folder is none";
    case EACCES: return "permission denied";
    case ELOOP: return "it is a link that leads nowhere: too many links one after the other";
    case ENAMETOOLONG: return "its name is too long";
    case EFBIG: return "the file would be larger than the system allows (ulimit -f)";
    default: return std::strerror(error);
  }
}

}  // namespace ifov::io
