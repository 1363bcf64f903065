#pragma once

#include <filesystem>
#include <string>

namespace ifov::cli {

/// What a folder of products, a run record or an ENVI file holds, in lines for people. Throws InputError on
/// files that are not such, SystemError on those that cannot be read.
std::string describe_product(const std::filesystem::path& path);

}  // namespace ifov::cli
