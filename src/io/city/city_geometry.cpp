#include "io/city/city_geometry.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "geometry/polygon_triangulation.h"
#include "io/mesh/polygon_pieces.h"

namespace ifov::io {
namespace {

using geometry::Triangle;
using math::Point3;
using math::Vec3;
using Type = DocumentNode::Type;

/// cos 60 deg and cos 30 deg, see read_city_json.
constexpr double kRoof = 0.5, kGround = 0.8660254037844386;

/// Rings of so few corners are cut by ear clipping, which needs no copy of them.
constexpr std::size_t kFewCorners = 64;

/// How many lists stand around the surfaces of a geometry; -1 where it has none.
int nesting_of(const std::string& type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 1;
  if (type == "Solid") return 2;
  if (type == "MultiSolid" || type == "CompositeSolid") return 3;
  return -1;
}

}  // namespace

const DocumentNode& required_member(const DocumentNode& node, std::string_view key) {
  if (node.type() != Type::object) node.fail_expected("an object");
  const DocumentNode* member = node.find(key);
  if (member == nullptr) node.fail(format("{} has no '{}'", node.title(), key));
  return *member;
}

const std::vector<DocumentNode>& list_of(const DocumentNode& node, std::string_view expected) {
  if (node.type() != Type::list) node.fail_expected(expected);
  return node.items();
}

const std::string& word_of(const DocumentNode& node) {
  if (node.type() != Type::text) node.fail_expected("a text");
  return node.text();
}

double number_of(const DocumentNode& node) {
  if (node.type() != Type::number) node.fail_expected("a number");
  return node.number();
}

std::size_t CityVertices::index(const DocumentNode& node) const {
  if (node.type() != Type::number || !node.is_integer() || node.integer() < 0 ||
      static_cast<std::uint64_t>(node.integer()) >= positions.size())
    node.fail_expected(positions.empty() ? std::string("a vertex, but the file has none")
                                         : format("a vertex from 0 to {}", positions.size() - 1));
  return static_cast<std::size_t>(node.integer());
}

void CityGeometry::add(const DocumentNode& geometry, const CityVertices& vertices,
                       const math::Transform& model_from_vertices, bool classify) {
  const int nesting = nesting_of(word_of(required_member(geometry, "type")));
  if (nesting < 0) {
    ++model_.lines_and_points;
    return;
  }
  Context context{&vertices, &model_from_vertices, nullptr, classify, {}};
  const DocumentNode* semantics = geometry.find("semantics");
  const DocumentNode* values = nullptr;
  if (semantics != nullptr && semantics->type() == Type::object) {
    context.surface_kinds = semantics->find("surfaces");
    values = semantics->find("values");
  }
  add_nested(context, required_member(geometry, "boundaries"), values, nesting);
}

void CityGeometry::add_nested(Context& context, const DocumentNode& boundaries, const DocumentNode* semantics,
                              int depth) {
  const auto& items = list_of(boundaries, "a list of boundaries");
  const std::vector<DocumentNode>* kinds = nullptr;
  if (semantics != nullptr && semantics->type() == Type::list) {
    kinds = &semantics->items();
    if (kinds->size() != items.size())
      semantics->fail(
          format("{} has {} entries for {} boundaries", semantics->title(), kinds->size(), items.size()));
  }
  for (std::size_t k = 0; k < items.size(); ++k) {
    // A number for a whole shell counts for all its surfaces.
    const DocumentNode* kind = kinds != nullptr ? &(*kinds)[k] : semantics;
    if (depth > 1)
      add_nested(context, items[k], kind, depth - 1);
    else
      add_surface(context, items[k], kind);
  }
}

void CityGeometry::add_surface(Context& context, const DocumentNode& node, const DocumentNode* semantic) {
  const auto& ring_nodes = list_of(node, "a list of rings");
  ++model_.surfaces;
  std::vector<std::vector<Point3>> rings;
  std::vector<std::size_t> indices;
  for (const DocumentNode& ring_node : ring_nodes) {
    const auto& corners = list_of(ring_node, "a list of vertices");
    std::vector<Point3> ring;
    std::vector<std::size_t> ring_indices;
    for (const DocumentNode& corner : corners) {
      const std::size_t index = context.vertices->index(corner);
      if (!ring_indices.empty() && ring_indices.back() == index) continue;
      ring_indices.push_back(index);
    }
    if (ring_indices.size() > 1 && ring_indices.front() == ring_indices.back()) ring_indices.pop_back();
    for (const std::size_t index : ring_indices)
      ring.push_back((*context.model_from_vertices)(context.vertices->positions[index]));
    indices.insert(indices.end(), ring_indices.begin(), ring_indices.end());
    rings.push_back(std::move(ring));
  }
  const Vec3 area = rings.empty() ? Vec3{} : geometry::polygon_area_vector(rings[0]);
  if (!(length(area) > 0.0)) {
    ++model_.empty_surfaces;
    return;
  }
  PolygonPieces pieces;
  if (rings.size() == 1 && rings[0].size() <= kFewCorners) {
    pieces.triangles = geometry::triangulate_polygon(rings[0]);
  } else {
    auto cut = cut_polygon(rings);
    if (!cut) node.fail(format("{} cannot be cut into triangles", node.title()));
    pieces = std::move(*cut);
  }
  if (pieces.repaired) ++model_.repaired_surfaces;
  if (pieces.triangles.empty()) {
    ++model_.empty_surfaces;
    return;
  }
  const std::uint32_t slot = slot_of(kind_of(context, semantic, normalized(area)));
  geometry::TriangleMesh& mesh = object_.mesh;
  std::vector<std::uint32_t> vertex_of(std::max(pieces.vertices.size(), indices.size()), geometry::kNoIndex);
  for (const Triangle& t : pieces.triangles) {
    Triangle corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& vertex = vertex_of[t[k]];
      if (vertex == geometry::kNoIndex)
        vertex =
            t[k] < indices.size() ? mesh_vertex(context, indices[t[k]]) : new_vertex(pieces.vertices[t[k]]);
      corners[k] = vertex;
    }
    mesh.triangles.push_back(corners);
    mesh.slots.push_back(slot);
  }
}

std::string CityGeometry::kind_of(const Context& context, const DocumentNode* semantic, Vec3 normal) const {
  if (semantic != nullptr && semantic->type() == Type::number && context.surface_kinds != nullptr) {
    const auto& kinds = list_of(*context.surface_kinds, "a list of semantic surfaces");
    if (!semantic->is_integer() || semantic->integer() < 0 ||
        static_cast<std::uint64_t>(semantic->integer()) >= kinds.size())
      semantic->fail_expected(format("one of the {} semantic surfaces", kinds.size()));
    const DocumentNode& kind = kinds[static_cast<std::size_t>(semantic->integer())];
    return word_of(required_member(kind, "type"));
  }
  if (!context.classify) return object_.type;
  return normal.z >= kRoof ? "RoofSurface" : normal.z <= -kGround ? "GroundSurface" : "WallSurface";
}

std::uint32_t CityGeometry::mesh_vertex(Context& context, std::size_t index) {
  const auto [entry, is_new] = context.known.try_emplace(index, 0);
  if (is_new) entry->second = new_vertex((*context.model_from_vertices)(context.vertices->positions[index]));
  return entry->second;
}

std::uint32_t CityGeometry::new_vertex(Point3 p) {
  geometry::TriangleMesh& mesh = object_.mesh;
  if (mesh.vertices_m.empty()) object_.origin = p;
  mesh.vertices_m.push_back(Point3{} + (p - object_.origin));
  model_.low = {std::min(model_.low.x, p.x), std::min(model_.low.y, p.y), std::min(model_.low.z, p.z)};
  model_.high = {std::max(model_.high.x, p.x), std::max(model_.high.y, p.y), std::max(model_.high.z, p.z)};
  return static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
}

std::uint32_t CityGeometry::slot_of(const std::string& name) {
  auto& names = object_.mesh.slot_names;
  const auto found = std::find(names.begin(), names.end(), name);
  const auto slot = static_cast<std::uint32_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return slot;
}

}  // namespace ifov::io
