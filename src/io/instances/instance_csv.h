#pragma once

#include <filesystem>
#include <vector>

#include "geometry/placements.h"
#include "io/instances/instance.h"

namespace ifov::io {

/// A list of instances in memory.
class InstanceList final : public geometry::Placements {
 public:
  explicit InstanceList(std::vector<Instance> instances) : instances_(std::move(instances)) {}
  std::size_t count() const override { return instances_.size(); }
  math::Transform at(std::size_t index) const override { return transform_of(instances_[index]); }
  const std::vector<Instance>& instances() const { return instances_; }

 private:
  std::vector<Instance> instances_;
};

/// Reads an instance list in text: a row for each copy, of x, y, z in metres, then, where all rows have them, yaw
/// (degrees, counter-clockwise from above), a scale, and pitch and roll (degrees): 3, 4, 5 or 7 numbers. Fields are
/// separated by commas, semicolons, tabs or blanks; one heading, empty lines and comments are skipped. Files of any
/// length. Throws InputError with file, line and column, SystemError where the file cannot be read.
std::vector<Instance> read_instance_csv(const std::filesystem::path& path);

}  // namespace ifov::io
