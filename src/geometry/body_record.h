#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/body.h"

namespace ifov::geometry {

/// The body of a mesh as bytes, for caches: lists in the order of their declaration, in this machine's byte order.
/// The pieces refer to the body; joined, they are the record.
struct BodyRecord {
  std::string head;  ///< counts, names and single values, a multiple of 8 bytes
  std::vector<std::span<const std::byte>> lists;
};
BodyRecord record_of(const Body& mesh_body);

/// The body back. Its lists lie in the bytes, which `keeper` keeps; they begin at a multiple of 8 bytes. Nothing where
/// the bytes make no sense: every size and every index is checked before it is used.
std::optional<Body> body_from_record(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper);

}  // namespace ifov::geometry
