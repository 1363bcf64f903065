#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/files/own_files.h"
#include "io/instances/instance.h"
#include "io/instances/instance_layout.h"

namespace ifov::io {

/// Writes a binary instance list (`.ifovinst`) of any length, record by record, beside its final name until
/// finish(); what was not finished is removed. Positions are written less `origin_m`, which the header keeps in double. Throws SystemError where
/// the file cannot be written, InputError for an instance that its layout cannot hold.
class InstanceWriter {
 public:
  InstanceWriter(std::filesystem::path path, InstanceLayout layout, math::Point3 origin_m = {});

  void add(const Instance& instance);
  void finish();

 private:
  void add_floats(const double* values, std::size_t count);
  void flush();

  std::filesystem::path path_;
  InstanceLayout layout_;
  math::Point3 origin_m_;
  NewFile file_;
  std::vector<char> buffer_;
  std::uint64_t count_ = 0;
};

}  // namespace ifov::io
