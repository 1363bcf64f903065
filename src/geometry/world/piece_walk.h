#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/world/prototype_plan.h"
#include "geometry/world/world_content.h"

namespace ifov::geometry {

/// A body as it stands in the scene: a whole object, or one of the parts of an object that stands apart. Its
/// patches, shapes and triangles are numbered on from where its part begins in the object.
struct PlacedPiece {
  std::uint32_t object = 0;
  std::uint32_t of = 0;         ///< template with the body
  std::uint32_t materials = 0;  ///< where its materials begin in the list
  std::uint32_t first_patch = 0, first_analytic = 0,
                first_triangle = 0;  ///< triangles count after all shapes
  math::Transform scene_from_body;
};

/// All pieces of a scene in a fixed order, worked out as they are asked for.
class PieceWalk {
 public:
  /// Adds the materials of parts to the content's list. Keeps a reference to the content.
  PieceWalk(WorldContent& content, const PrototypePlan& plan, const std::vector<Contents>& contents);

  using Visitor = std::function<void(const PlacedPiece&)>;
  void visit(const Visitor& visitor) const;

 private:
  struct Branch;
  /// A template with its materials settled.
  struct Node {
    std::uint32_t of = 0, materials = 0;
    std::vector<Branch> branches;  ///< empty: it has a body
  };
  struct Branch {
    const TemplatePart* part = nullptr;
    std::unique_ptr<Node> node;
    std::uint32_t first_patch = 0, first_analytic = 0, first_triangle = 0;  ///< of the first copy
  };
  Node node_of(std::uint32_t of, std::uint32_t materials);
  void visit(const Node& node, PlacedPiece piece, const Visitor& visitor) const;

  WorldContent& content_;
  const PrototypePlan& plan_;
  const std::vector<Contents>& contents_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> node_of_run_;
};

}  // namespace ifov::geometry
