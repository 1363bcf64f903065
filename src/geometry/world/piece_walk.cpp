#include "geometry/world/piece_walk.h"

#include <map>
#include <utility>

namespace ifov::geometry {

PieceWalk::PieceWalk(WorldContent& content, const PrototypePlan& plan, const std::vector<Contents>& contents)
    : content_(content), plan_(plan), contents_(contents) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (const Run& run : content.runs) {
    const auto [entry, is_new] =
        known.try_emplace({run.what.of, run.materials}, static_cast<std::uint32_t>(nodes_.size()));
    if (is_new) nodes_.push_back(node_of(run.what.of, run.materials));
    node_of_run_.push_back(entry->second);
  }
}

PieceWalk::Node PieceWalk::node_of(std::uint32_t of, std::uint32_t materials) {
  Node node{of, materials, {}};
  if (plan_.flat[of]) return node;
  Contents before;
  for (const TemplatePart& part : content_.templates[of].parts) {
    const auto list = static_cast<std::uint32_t>(content_.materials.size());
    for (std::uint32_t s = 0; s < content_.templates[part.of].slot_count; ++s)
      content_.materials.push_back(content_.materials[materials + (part.slots.empty() ? 0u : part.slots[s])]);
    node.branches.push_back({&part, std::make_unique<Node>(node_of(part.of, list)), before.patches,
                             static_cast<std::uint32_t>(before.shapes),
                             static_cast<std::uint32_t>(before.triangles)});
    const Contents& inner = contents_[part.of];
    before.patches += static_cast<std::uint32_t>(part.copies()) * inner.patches;
    before.shapes += part.copies() * inner.shapes;
    before.triangles += part.copies() * inner.triangles;
  }
  return node;
}

void PieceWalk::visit(const Visitor& visitor) const {
  for (std::size_t r = 0; r < content_.runs.size(); ++r) {
    const Run& run = content_.runs[r];
    if (!content_.templates[run.what.of].has_body()) continue;
    const Node& node = nodes_[node_of_run_[r]];
    PlacedPiece piece;
    piece.of = run.what.of;
    // Triangles of an object are numbered after all its shapes.
    piece.first_triangle = static_cast<std::uint32_t>(contents_[run.what.of].shapes);
    for (std::size_t k = 0; k < run.what.copies(); ++k) {
      piece.object = run.first_object + static_cast<std::uint32_t>(k);
      piece.scene_from_body = run.what.whole_from_copy(k);
      visit(node, piece, visitor);
    }
  }
}

void PieceWalk::visit(const Node& node, PlacedPiece piece, const Visitor& visitor) const {
  piece.of = node.of;
  piece.materials = node.materials;
  if (node.branches.empty()) return visitor(piece);
  for (const Branch& branch : node.branches) {
    const Contents& inner = contents_[branch.part->of];
    for (std::size_t k = 0; k < branch.part->copies(); ++k) {
      const auto n = static_cast<std::uint32_t>(k);
      PlacedPiece part = piece;
      part.scene_from_body = piece.scene_from_body * branch.part->whole_from_copy(k);
      part.first_patch += branch.first_patch + n * inner.patches;
      part.first_analytic += branch.first_analytic + n * static_cast<std::uint32_t>(inner.shapes);
      part.first_triangle += branch.first_triangle + n * static_cast<std::uint32_t>(inner.triangles);
      visit(*branch.node, part, visitor);
    }
  }
}

}  // namespace ifov::geometry
