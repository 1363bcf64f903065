#include "geometry/world/prototype_plan.h"

#include <algorithm>
#include <limits>
#include <map>

#include "core/byte_count.h"
#include "core/error.h"
#include "core/machine_memory.h"

namespace ifov::geometry {
namespace {

// Bytes in memory, trees included.
constexpr double kTriangleBytes = 140.0, kShapeBytes = 300.0, kInstanceBytes = 220.0;
constexpr double kLeastInstanceBytes = 70.0;  // in a table of our own
/// What is flattened without a look at the alternative.
constexpr double kSmall_bytes = 64.0 * 1048576.0;

double flat_bytes(const Contents& c) {
  return kTriangleBytes * static_cast<double>(c.triangles) + kShapeBytes * static_cast<double>(c.shapes);
}

/// The least that the parts of a prototype can take, each kept once.
class Least {
 public:
  Least(const WorldContent& content, const std::vector<Contents>& contents)
      : content_(content), contents_(contents) {}

  /// Bytes of a template kept once, flat or in parts.
  double whole(std::uint32_t t) const {
    const double flat = flat_bytes(contents_[t]);
    return content_.templates[t].is_prototype() ? std::min(flat, apart(t, 1.0)) : flat;
  }
  /// Bytes where `copies` of a prototype stand in parts.
  double apart(std::uint32_t t, double copies) const {
    double bytes = 0.0;
    std::vector<std::uint32_t> kinds;
    for (const TemplatePart& part : content_.templates[t].parts) {
      bytes += copies * static_cast<double>(part.copies()) * kInstanceBytes;
      kinds.push_back(part.of);
    }
    std::sort(kinds.begin(), kinds.end());
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    for (const std::uint32_t kind : kinds) bytes += whole(kind);
    return bytes;
  }

 private:
  const WorldContent& content_;
  const std::vector<Contents>& contents_;
};

/// Before anything is built: copies that cannot even be listed.
void require_room(const PrototypePlan& plan) {
  std::uint64_t copies = 0;
  for (const std::uint64_t standing : plan.copies) copies += standing > 1 ? standing : 0;
  const double bytes = kLeastInstanceBytes * static_cast<double>(copies);
  if (const std::uint64_t room = memory_within_reach_bytes(); room > 0 && bytes > static_cast<double>(room))
    throw SystemError(format("{:.3g} copies of objects take at least {}, and {} of memory are there",
                             static_cast<double>(copies), byte_count(static_cast<std::uint64_t>(bytes)),
                             byte_count(room)));
}

Body body_from_parts(const WorldContent& content, std::uint32_t of, std::map<std::uint32_t, Body>& inner) {
  const Template& t = content.templates[of];
  JoinedBody whole(t.slot_count);
  for (const TemplatePart& part : t.parts) {
    const Template& child = content.templates[part.of];
    const Body* body = &child.body;
    if (child.is_prototype() && body->patch_count == 0) {
      if (!inner.contains(part.of)) inner.emplace(part.of, body_from_parts(content, part.of, inner));
      body = &inner.at(part.of);
    }
    for (std::size_t k = 0; k < part.copies(); ++k) whole.add(*body, part.whole_from_copy(k), part.slots);
  }
  return std::move(whole).take();
}

}  // namespace

std::vector<Contents> contents_of(const WorldContent& content) {
  std::vector<Contents> all(content.templates.size());
  for (std::size_t t = 0; t < all.size(); ++t) {
    const Template& one = content.templates[t];
    Contents& c = all[t];
    c = {one.body.mesh.triangles.size(), one.body.analytic.size(), one.body.patch_count};
    if (one.field) c = {one.field->triangles(), 0, 1};
    for (const TemplatePart& part : one.parts) {
      const std::uint64_t copies = part.copies();
      const Contents& inner = all[part.of];
      constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / 4;
      if (copies > 0 && std::max(inner.triangles, inner.shapes) > kMost / copies)
        throw InputError("prototypes within prototypes hold more triangles than can be counted");
      c.triangles += copies * inner.triangles;
      c.shapes += copies * inner.shapes;
      c.patches += static_cast<std::uint32_t>(copies) * inner.patches;
      if (std::max(c.triangles, c.shapes) > kMost)
        throw InputError("prototypes within prototypes hold more triangles than can be counted");
    }
  }
  return all;
}

PrototypePlan plan_prototypes(const WorldContent& content, const std::vector<Contents>& contents) {
  const Least least(content, contents);
  PrototypePlan plan;
  plan.flat.assign(content.templates.size(), true);
  plan.copies.assign(content.templates.size(), 0);
  for (std::size_t t = 0; t < content.templates.size(); ++t) plan.copies[t] = content.templates[t].uses;
  for (std::size_t t = content.templates.size(); t-- > 0;) {
    const Template& one = content.templates[t];
    if (!one.is_prototype() || plan.copies[t] == 0) continue;
    const double copies = static_cast<double>(plan.copies[t]), flat = flat_bytes(contents[t]);
    const bool countable = contents[t].triangles < kNoIndex && contents[t].shapes < kNoIndex;
    const double flat_total = flat + (copies > 1.0 ? copies * kInstanceBytes : 0.0);
    if (countable &&
        (flat <= kSmall_bytes || flat_total <= least.apart(static_cast<std::uint32_t>(t), copies)))
      continue;
    plan.flat[t] = false;
    ++plan.apart;
    for (const TemplatePart& part : one.parts) {
      const double standing = copies * static_cast<double>(part.copies());
      if (standing + static_cast<double>(plan.copies[part.of]) >= kNoIndex)
        throw InputError(format(
            "prototypes within prototypes make {:.3g} copies of {:.3g} triangles: too many to be placed, and "
            "too large to be joined into one",
            standing, static_cast<double>(contents[part.of].triangles)));
      plan.copies[part.of] += plan.copies[t] * part.copies();
    }
    plan.copies[t] = 0;
  }
  require_room(plan);
  return plan;
}

void flatten(WorldContent& content, const PrototypePlan& plan) {
  std::map<std::uint32_t, Body> inner;
  for (std::uint32_t t = 0; t < content.templates.size(); ++t)
    if (content.templates[t].is_prototype() && plan.flat[t] && plan.copies[t] > 0)
      content.templates[t].body = body_from_parts(content, t, inner);
}

}  // namespace ifov::geometry
