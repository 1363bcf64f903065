#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/city/city_model.h"
#include "io/json/node.h"
#include "math/transform.h"

namespace ifov::io {

/// Typed access to a node that fails with what was expected.
const DocumentNode& required_member(const DocumentNode& node, std::string_view key);
const std::vector<DocumentNode>& list_of(const DocumentNode& node, std::string_view expected);
const std::string& word_of(const DocumentNode& node);
double number_of(const DocumentNode& node);

/// The vertices of one list of the file and how they are placed.
struct CityVertices {
  std::vector<math::Point3> positions;

  /// The vertex that a node names.
  std::size_t index(const DocumentNode& node) const;
};

/// Adds the surfaces of one geometry after another to the mesh of an object.
class CityGeometry {
 public:
  CityGeometry(CityObject& object, CityModel& model) : object_(object), model_(model) {}

  /// `model_from_vertices` moves the vertices (of templates); `classify` tells surfaces without semantics
  /// apart by their normals. Throws InputError.
  void add(const DocumentNode& geometry, const CityVertices& vertices,
           const math::Transform& model_from_vertices, bool classify);

 private:
  struct Context {
    const CityVertices* vertices;
    const math::Transform* model_from_vertices;
    const DocumentNode* surface_kinds;
    bool classify;
    std::unordered_map<std::size_t, std::uint32_t> known;  ///< vertex of the file -> of the mesh
  };
  void add_nested(Context& context, const DocumentNode& boundaries, const DocumentNode* semantics, int depth);
  void add_surface(Context& context, const DocumentNode& rings, const DocumentNode* semantic);
  std::string kind_of(const Context& context, const DocumentNode* semantic, math::Vec3 normal) const;
  std::uint32_t mesh_vertex(Context& context, std::size_t index);
  std::uint32_t new_vertex(math::Point3 position);
  std::uint32_t slot_of(const std::string& name);

  CityObject& object_;
  CityModel& model_;
};

}  // namespace ifov::io
