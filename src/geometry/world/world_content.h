#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/body.h"
#include "geometry/height_field.h"
#include "geometry/placements.h"
#include "geometry/presence.h"
#include "geometry/shapes.h"
#include "math/transform.h"

namespace ifov::geometry {

/// Copies of one template as part of another: one, or one for each entry of a list.
struct TemplatePart {
  std::uint32_t of = 0;
  math::Transform whole_from_list;
  std::shared_ptr<const Placements> list;  ///< null: one copy, whole_from_list itself
  std::vector<std::uint32_t> slots;        ///< the whole's slot for each slot of the part; empty: all 0

  std::size_t copies() const { return list ? list->count() : 1; }
  math::Transform whole_from_copy(std::size_t k) const {
    return list ? whole_from_list * list->at(k) : whole_from_list;
  }
};

/// A shape or prototype as the builder hands it over: a plane, a height field, a body, or parts that may become a body.
struct Template {
  std::optional<Plane> plane;
  std::shared_ptr<const HeightField> field;
  Body body;
  std::vector<TemplatePart> parts;  ///< of a prototype; they refer to templates before it
  std::uint32_t slot_count = 1;
  std::uint64_t uses = 0;  ///< placed objects
  bool nothing = false;    ///< a prototype of lists without a copy: it can be placed, and nothing is there

  bool has_body() const { return !plane && !field; }
  bool is_prototype() const { return !parts.empty(); }
};

/// Objects placed at once: one, or one for each entry of a list.
struct Run {
  TemplatePart what;            ///< slots are not used
  std::uint32_t materials = 0;  ///< where their materials begin in the list, one per slot
  std::uint32_t first_object = 0;
  bool pilot_ray = true;
  std::shared_ptr<const Presence> presence{};  ///< null: always there
};

struct WorldContent {
  std::vector<Template> templates;
  std::vector<Run> runs;
  std::uint32_t object_count = 0;
  std::vector<std::uint32_t> materials;
};

}  // namespace ifov::geometry
