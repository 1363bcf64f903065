#include "io/city/city_json_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/names.h"
#include "io/city/city_geometry.h"
#include "io/files/input_file.h"
#include "io/json/json_adapter.h"
#include "io/mesh/gltf_reader.h"

namespace ifov::io {
namespace {

using math::Point3;
using math::Transform;
using Type = DocumentNode::Type;

constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr std::size_t kMostGenerations = 8;
constexpr double kLargestCoordinate = 1e9;

/// A level of detail is a number in version 1.0 and a text since.
std::string lod_of(const DocumentNode& geometry) {
  const DocumentNode* lod = geometry.find("lod");
  if (lod == nullptr) return {};
  if (lod->type() == Type::number) return format("{}", lod->number());
  return word_of(*lod);
}

bool same_lod(const std::string& a, const std::string& b) {
  const auto without_zero = [](const std::string& lod) {
    return lod.ends_with(".0") ? lod.substr(0, lod.size() - 2) : lod;
  };
  return without_zero(a) == without_zero(b);
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, const CityJsonChoice& choice)
      : choice_(choice), name_(path.string()) {
    JsonRules rules;
    rules.comments = false;
    rules.max_bytes = kMostBytes;
    rules.max_values = kMostBytes;
    tree_ = parse_json(read_input(path), name_, rules);
  }

  CityModel read() {
    const DocumentNode& root = *tree_.root;
    if (word_of(required_member(root, "type")) != "CityJSON")
      root.find("type")->fail_expected("\"CityJSON\"");
    const DocumentNode& version = required_member(root, "version");
    model_.version = word_of(version);
    if (model_.version != "1.0" && model_.version != "1.1" && model_.version != "2.0" &&
        model_.version != "2.0.1" && model_.version != "2.0.0" && model_.version != "1.1.0" &&
        model_.version != "1.0.0")
      version.fail_expected("\"1.0\", \"1.1\" or \"2.0\"");
    read_reference_system(root);
    vertices_ = vertices_of(required_member(root, "vertices"));
    apply_transform(root);
    read_templates(root);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    model_.low = {kInfinity, kInfinity, kInfinity};
    model_.high = {-kInfinity, -kInfinity, -kInfinity};
    read_objects(required_member(root, "CityObjects"));
    finish();
    return std::move(model_);
  }

 private:
  void read_reference_system(const DocumentNode& root) {
    const DocumentNode* metadata = root.find("metadata");
    if (metadata == nullptr || metadata->type() != Type::object) return;
    const DocumentNode* system = metadata->find("referenceSystem");
    if (system != nullptr && system->type() == Type::text) model_.reference_system = system->text();
  }

  static CityVertices vertices_of(const DocumentNode& list) {
    CityVertices vertices;
    const auto& items = list_of(list, "a list of vertices");
    vertices.positions.reserve(items.size());
    for (const DocumentNode& item : items) {
      const auto& p = list_of(item, "three coordinates");
      if (p.size() != 3) item.fail_expected("three coordinates");
      vertices.positions.push_back({number_of(p[0]), number_of(p[1]), number_of(p[2])});
    }
    return vertices;
  }

  void apply_transform(const DocumentNode& root) {
    const DocumentNode* transform = root.find("transform");
    if (transform != nullptr) {
      const auto three = [&](const char* key) {
        const DocumentNode& node = required_member(*transform, key);
        const auto& v = list_of(node, "three numbers");
        if (v.size() != 3) node.fail_expected("three numbers");
        return math::Vec3{number_of(v[0]), number_of(v[1]), number_of(v[2])};
      };
      const math::Vec3 scale = three("scale"), shift = three("translate");
      for (Point3& p : vertices_.positions)
        p = {p.x * scale.x + shift.x, p.y * scale.y + shift.y, p.z * scale.z + shift.z};
    }
    for (std::size_t k = 0; k < vertices_.positions.size(); ++k) {
      const Point3 p = vertices_.positions[k];
      if (!(std::abs(p.x) < kLargestCoordinate && std::abs(p.y) < kLargestCoordinate &&
            std::abs(p.z) < kLargestCoordinate))
        required_member(root, "vertices")
            .items()[k]
            .fail(format("this vertex lies more than {} m from the origin", kLargestCoordinate));
    }
  }

  void read_templates(const DocumentNode& root) {
    const DocumentNode* node = root.find("geometry-templates");
    if (node == nullptr) return;
    templates_ = &list_of(required_member(*node, "templates"), "a list of geometries");
    template_vertices_ = vertices_of(required_member(*node, "vertices-templates"));
  }

  void read_objects(const DocumentNode& objects) {
    if (objects.type() != Type::object) objects.fail_expected("an object");
    for (const DocumentNode& object : objects.members()) {
      if (!nodes_.emplace(object.key(), &object).second)
        object.fail_at_key("an object of this name was there before");
      order_.push_back(&object);
    }
    std::map<std::string, std::size_t> place;
    for (const DocumentNode* node : order_) {
      const DocumentNode& root = root_of(*node);
      if (!taken(root)) continue;
      const DocumentNode* geometries = node->find("geometry");
      if (geometries == nullptr || geometries->type() == Type::null) continue;
      const auto& list = list_of(*geometries, "a list of geometries");
      if (list.empty()) continue;
      const auto [entry, is_new] = place.try_emplace(root.key(), model_.objects.size());
      if (is_new) {
        model_.objects.push_back(
            {root.key(), word_of(required_member(root, "type")), attributes_of(root), {}, {}, {}});
      }
      add_geometries(*node, list, model_.objects[entry->second]);
    }
  }

  /// The object that this one belongs to in the end.
  const DocumentNode& root_of(const DocumentNode& object) const {
    const DocumentNode* at = &object;
    for (std::size_t steps = 0;; ++steps) {
      if (at->type() != Type::object) at->fail_expected("an object");
      const DocumentNode* parents = at->find("parents");
      // City object groups may list their members' parents; a building has one.
      if (parents == nullptr || parents->type() != Type::list || parents->items().empty()) return *at;
      if (steps == kMostGenerations) object.fail_at_key("the parents of this object run in a circle");
      const DocumentNode& parent = parents->items()[0];
      const auto found = nodes_.find(word_of(parent));
      if (found == nodes_.end()) parent.fail(format("there is no object '{}'", parent.text().substr(0, 100)));
      at = found->second;
    }
  }

  bool taken(const DocumentNode& object) {
    const std::string& type = word_of(required_member(object, "type"));
    types_.insert(type);
    return choice_.types.empty() ||
           std::find(choice_.types.begin(), choice_.types.end(), type) != choice_.types.end();
  }

  static std::vector<std::pair<std::string, std::string>> attributes_of(const DocumentNode& object) {
    std::vector<std::pair<std::string, std::string>> attributes;
    const DocumentNode* node = object.find("attributes");
    if (node == nullptr || node->type() != Type::object) return attributes;
    for (const DocumentNode& member : node->members()) {
      if (member.type() == Type::text)
        attributes.emplace_back(member.key(), member.text());
      else if (member.type() == Type::number)
        attributes.emplace_back(member.key(), format("{}", member.number()));
      else if (member.type() == Type::boolean)
        attributes.emplace_back(member.key(), member.boolean() ? "true" : "false");
    }
    return attributes;
  }

  void add_geometries(const DocumentNode& node, const std::vector<DocumentNode>& geometries,
                      CityObject& object) {
    std::string finest;
    for (const DocumentNode& geometry : geometries) {
      const std::string lod = lod_of(lod_carrier(geometry));
      lods_.insert(lod);
      // Levels of detail ("1", "1.3", "2.2") sort as texts.
      if (lod > finest) finest = lod;
    }
    const std::string wanted = choice_.lod.empty() ? finest : choice_.lod;
    const std::string& type = word_of(required_member(node, "type"));
    const bool classify = type.starts_with("Building");
    CityGeometry builder(object, model_);
    bool any = false;
    for (const DocumentNode& geometry : geometries) {
      const DocumentNode& carrier = lod_carrier(geometry);
      if (!same_lod(lod_of(carrier), wanted)) continue;
      any = true;
      if (&carrier == &geometry)
        builder.add(geometry, vertices_, Transform(), classify);
      else
        add_instance(builder, object.mesh, geometry, carrier, classify);
    }
    if (!any) ++model_.objects_without_lod;
    if (any && wanted > object.lod) object.lod = wanted;
  }

  /// The geometry itself, or the template that it copies.
  const DocumentNode& lod_carrier(const DocumentNode& geometry) const {
    if (word_of(required_member(geometry, "type")) != "GeometryInstance") return geometry;
    const DocumentNode& number = required_member(geometry, "template");
    const std::size_t count = templates_ == nullptr ? 0 : templates_->size();
    if (number.type() != Type::number || !number.is_integer() || number.integer() < 0 ||
        static_cast<std::uint64_t>(number.integer()) >= count)
      number.fail_expected(format("one of the {} geometry templates", count));
    return (*templates_)[static_cast<std::size_t>(number.integer())];
  }

  void add_instance(CityGeometry& builder, const geometry::TriangleMesh& mesh, const DocumentNode& geometry,
                    const DocumentNode& source, bool classify) {
    const DocumentNode& boundaries = required_member(geometry, "boundaries");
    const auto& anchor = list_of(boundaries, "the one vertex of the reference point");
    if (anchor.size() != 1) boundaries.fail_expected("the one vertex of the reference point");
    const Point3 p = vertices_.positions[vertices_.index(anchor[0])];
    const DocumentNode& matrix = required_member(geometry, "transformationMatrix");
    const auto& m = list_of(matrix, "16 numbers, row by row");
    if (m.size() != 16) matrix.fail_expected("16 numbers, row by row");
    const auto at = [&](std::size_t row, std::size_t column) { return number_of(m[4 * row + column]); };
    const auto column = [&](std::size_t k) { return math::Vec3{at(0, k), at(1, k), at(2, k)}; };
    const Transform model_from_template =
        Transform::from_columns(column(0), column(1), column(2), p + column(3));
    const Point3 o = model_from_template.origin_m();
    if (!(std::abs(o.x) < kLargestCoordinate && std::abs(o.y) < kLargestCoordinate &&
          std::abs(o.z) < kLargestCoordinate))
      matrix.fail("this copy lies too far away");
    const std::size_t before = mesh.triangles.size();
    builder.add(source, template_vertices_, model_from_template, classify);
    unfolded_ += mesh.triangles.size() - before;
    if (unfolded_ > kMostUnfoldedTriangles)
      geometry.fail(format("copies of templates unfold to more than {} triangles", kMostUnfoldedTriangles));
  }

  void finish() {
    std::erase_if(model_.objects, [](const CityObject& object) { return object.mesh.triangles.empty(); });
    if (!model_.objects.empty()) return;
    const auto listed = [](const std::set<std::string>& names) {
      std::vector<std::string> shown;
      for (const std::string& name : names) shown.push_back(name.empty() ? "none" : name);
      return shown.empty() ? std::string("none") : list_names(shown, "and");
    };
    if (!choice_.types.empty() && std::none_of(choice_.types.begin(), choice_.types.end(),
                                               [&](const std::string& t) { return types_.contains(t); }))
      throw InputError(format("{}: no object is of a type asked for; the file has {}", name_, listed(types_)),
                       {name_, 0, 0});
    if (model_.objects_without_lod > 0)
      throw InputError(format("{}: no object has the level of detail {}; the file has {}", name_, choice_.lod,
                              listed(lods_)),
                       {name_, 0, 0});
    throw InputError(format("{}: the file has no surfaces", name_), {name_, 0, 0});
  }

  CityJsonChoice choice_;
  std::string name_;
  DocumentTree tree_;
  CityModel model_;
  CityVertices vertices_, template_vertices_;
  const std::vector<DocumentNode>* templates_ = nullptr;
  std::map<std::string, const DocumentNode*> nodes_;
  std::vector<const DocumentNode*> order_;
  std::set<std::string> types_, lods_;
  std::size_t unfolded_ = 0;
};

}  // namespace

CityModel read_city_json(const std::filesystem::path& path, const CityJsonChoice& choice) {
  return Reader(path, choice).read();
}

}  // namespace ifov::io
