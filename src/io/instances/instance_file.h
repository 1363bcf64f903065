#pragma once

#include <filesystem>

#include "geometry/placements.h"
#include "io/files/mapped_file.h"
#include "io/instances/instance.h"
#include "io/instances/instance_layout.h"

namespace ifov::io {

/// A binary instance list (`.ifovinst`, docs/formats/instances.md) as it lies on disk, mapped into memory; either
/// byte order. The header is checked against the file's size and every record for sense when it is opened.
class InstanceFile final : public geometry::Placements {
 public:
  /// Throws InputError that names the file and what is wrong, SystemError where it cannot be read.
  explicit InstanceFile(const std::filesystem::path& path);

  std::size_t count() const override { return count_; }
  math::Transform at(std::size_t index) const override;
  Instance instance(std::size_t index) const;
  const InstanceLayout& layout() const { return layout_; }

 private:
  void read_header(const std::string& name);
  void check_records(const std::string& name) const;

  MappedFile file_;
  InstanceLayout layout_;
  std::size_t count_ = 0, record_bytes_ = 0;
  bool swapped_ = false;
  math::Point3 origin_m_;
};

}  // namespace ifov::io
