// Construction of the world: where everything stands, what becomes an instance, Embree's trees.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "geometry/growing_box.h"
#include "geometry/mesh_chunks.h"
#include "geometry/world/embree_world.h"
#include "geometry/world/survey_of.h"

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Transform;
using math::Vec3;

/// Up to this many primitives a copy in the scene costs less than an instance.
constexpr std::size_t kCopiedTriangles = 4, kCopiedShapes = 2;

/// Up to this many instances are nodes of Embree's tree.
constexpr std::size_t kMostNodes = 1000000;

/// Scenes of more stored triangles make the trees of large meshes as rays come near.
constexpr std::uint64_t kMostTrianglesAtOnce = 1 << 21;

/// Of a node that Embree's monitor does not see (370 bytes in all, 80 seen).
constexpr std::size_t kUnseenNodeBytes = 290;

bool better_copied(const Body& body, std::uint64_t copies) {
  return copies == 1 ||
         (body.mesh.triangles.size() <= kCopiedTriangles && body.analytic.size() <= kCopiedShapes);
}

bool has_attributes(const MeshLists& mesh) { return !mesh.normals.empty() || !mesh.uvs.empty(); }

/// Bounds of a placed body, by its vertices and shapes; by the corners of boxes where it is `chunked`.
World::Bounds close_bounds(const Body& body, const Transform& scene_from_body, bool chunked) {
  GrowingBox box;
  if (chunked) {
    for (const MeshChunk& chunk : body.mesh.chunks)
      for (int corner = 0; corner < 8; ++corner) {
        const auto& [low, high] = chunk.bounds;
        const Point3 p =
            scene_from_body(Point3{(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                   (corner & 4) != 0 ? high.z : low.z});
        box.include(p, p);
      }
  } else {
    for (const Triangle& t : body.mesh.triangles)
      for (const std::uint32_t i : t) {
        const Point3 p = scene_from_body(body.mesh.vertices_m[i]);
        box.include(p, p);
      }
  }
  for (const UnitPrimitive& p : body.analytic)
    box.include(unit_bounds(p.kind, scene_from_body * p.unit_from_object.inverse()));
  return box.bounds;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

std::size_t bytes_of(const AnalyticSet& set) { return bytes_of(set.shapes) + bytes_of(set.owners); }

}  // namespace

EmbreeWorld::EmbreeWorld(WorldContent content, const BuildOptions& options)
    : device_(make_device(options.threads, embree_bytes_)) {
  const std::vector<Contents> contents = contents_of(content);
  const PrototypePlan plan = plan_prototypes(content, contents);
  flatten(content, plan);
  const PieceWalk walk(content, plan, contents);
  std::vector<bool> instanced(content.templates.size());
  for (std::size_t t = 0; t < instanced.size(); ++t)
    instanced[t] = content.templates[t].has_body() && plan.flat[t] && plan.copies[t] > 0 &&
                   !better_copied(content.templates[t].body, plan.copies[t]);
  for (const Run& run : content.runs) triangle_count_ += run.what.copies() * contents[run.what.of].triangles;
  materials_ = content.materials;
  cut_outs_ = options.cut_outs;
  if (std::none_of(cut_outs_.begin(), cut_outs_.end(), [](const auto& one) { return one != nullptr; }))
    cut_outs_.clear();
  else
    for (const std::uint32_t material : materials_)
      if (material >= cut_outs_.size()) cut_outs_.resize(material + 1);
  if (!options.surveyed.empty())
    survey_ = std::make_unique<const SurfaceSurvey>(survey_of(content, walk, options.surveyed));
  if (!options.lobes.empty())
    lobe_survey_ = std::make_unique<const SurfaceSurvey>(survey_of(content, walk, options.lobes, true));
  choose_chunked(content, plan, instanced, options.large_meshes);
  note_figures(content, plan);
  note_objects(content, instanced);
  note_presences(content);
  std::vector<double> shrink(content.templates.size(), 1.0);
  find_bounds(content, walk, instanced, shrink);
  build_prototypes(content, instanced, shrink);
  place_pieces(content, walk, plan, instanced);
  place_fields(content);
  build_scene(options.instances);
  note_storage(plan);
}

void EmbreeWorld::choose_chunked(WorldContent& content, const PrototypePlan& plan,
                                 const std::vector<bool>& instanced, LargeMeshes how) {
  is_chunked_.assign(content.templates.size(), false);
  if (how == LargeMeshes::at_once) return;
  std::uint64_t triangles = 0;
  for (std::size_t t = 0; t < content.templates.size(); ++t)
    triangles += (instanced[t] ? 1 : plan.copies[t]) * content.templates[t].body.mesh.triangles.size();
  if (how == LargeMeshes::by_number && triangles <= kMostTrianglesAtOnce) return;
  for (std::size_t t = 0; t < content.templates.size(); ++t) {
    MeshLists& mesh = content.templates[t].body.mesh;
    if (plan.copies[t] == 0 || mesh.triangles.size() <= kMostInChunk) continue;
    if (mesh.chunks.empty()) divide(mesh);
    is_chunked_[t] = true;
  }
}

void EmbreeWorld::find_heights(const WorldContent& content, GrowingBox box) {
  for (const Run& run : content.runs)
    if (const std::optional<Plane>& plane = content.templates[run.what.of].plane) {
      const Point3 on_plane = run.what.whole_from_list(Point3{0.0, 0.0, plane->z_m});
      box.include(on_plane, on_plane);
    }
  if (!box.empty()) heights_ = {box.bounds.low_m.z, box.bounds.high_m.z};
}

void EmbreeWorld::find_bounds(const WorldContent& content, const PieceWalk& walk,
                              const std::vector<bool>& instanced, std::vector<double>& shrink) {
  GrowingBox box;
  walk.visit([&](const PlacedPiece& piece) {
    const Body& body = content.templates[piece.of].body;
    if (!instanced[piece.of])
      return box.include(close_bounds(body, piece.scene_from_body, is_chunked_[piece.of]));
    box.include(image_of(body.bounds, piece.scene_from_body));
    // Rays reach an instance with the rounding of the scene, seen at the instance's scale.
    if (!body.analytic.empty() || is_chunked_[piece.of])
      shrink[piece.of] = std::max(shrink[piece.of], largest_stretch(piece.scene_from_body.inverse()));
  });
  for (const Run& run : content.runs)
    if (const auto& field = content.templates[run.what.of].field)
      box.include(image_of(field->bounds(), run.what.whole_from_list));
  if (!box.empty()) bounds_ = box.bounds;
  find_heights(content, box);

  centre_m_ = bounds_.low_m + (bounds_.high_m - bounds_.low_m) * 0.5;
  const Vec3 half = (bounds_.high_m - bounds_.low_m) * 0.5;
  scale_m_ = std::max({half.x, half.y, half.z});
  // Embree's floats err by a few units of 2^-24 of the scene's size; at grazing incidence by many times that.
  window_m_ = std::ldexp(scale_m_, -17);
  same_m_ = std::ldexp(scale_m_, -34);
  triangle_offset_m_ = std::ldexp(scale_m_, -22);
  const double padding = box_padding_m();
  padded_ = {{-half.x - padding, -half.y - padding, -half.z - padding},
             {half.x + padding, half.y + padding, half.z + padding}};
}

double EmbreeWorld::box_padding_m() const { return std::ldexp(scale_m_, -20); }

void EmbreeWorld::build_prototypes(WorldContent& content, const std::vector<bool>& instanced,
                                   const std::vector<double>& shrink) {
  prototypes_.resize(content.templates.size());
  attributes_of_.assign(content.templates.size(), kNoIndex);
  for (std::size_t t = 0; t < content.templates.size(); ++t) {
    if (!instanced[t]) continue;
    Body& body = content.templates[t].body;
    auto prototype = std::make_unique<Prototype>();
    const Transform set_from_object = Transform::translation(Point3{} - body.centre_m);
    prototype->analytic.append(body, set_from_object);
    prototype->analytic.padding_m = box_padding_m() * shrink[t];
    // In a heap of leaves there is nothing behind a shared vertex to leak into.
    const bool robust = 20 * body.surface_triangles > body.mesh.triangles.size();
    prototype->scene = make_scene(device_.get(), robust);
    storage_.stored_triangles += body.mesh.triangles.size();
    if (is_chunked_[t]) {
      prototype->chunked = std::make_unique<ChunkedMesh>(
          device_.get(), body.mesh, ChunkPlacement{set_from_object, 0, robust, box_padding_m() * shrink[t]},
          late_failure_);
      prototype->chunked->attach_to(prototype->scene.get(), 0);
      storage_.chunks += body.mesh.chunks.size();
    } else if (!body.mesh.triangles.empty()) {
      prototype->triangles.append(body, set_from_object);
      attach_triangles(device_.get(), prototype->scene.get(), 0, prototype->triangles);
    }
    if (!prototype->analytic.shapes.empty())
      attach_analytic(device_.get(), prototype->scene.get(), 1, prototype->analytic);
    commit(device_.get(), prototype->scene.get());
    prototypes_[t] = std::move(prototype);
    if (has_attributes(body.mesh)) {
      attributes_of_[t] = static_cast<std::uint32_t>(attributes_.size());
      attributes_.push_back({std::move(body.mesh), body.centre_m});
    }
    body.mesh = {};
  }
}

void EmbreeWorld::place_pieces(WorldContent& content, const PieceWalk& walk, const PrototypePlan& plan,
                               const std::vector<bool>& instanced) {
  const Transform centred_from_scene = Transform::translation(Point3{} - centre_m_);
  std::uint64_t instances = 0;
  for (std::size_t t = 0; t < instanced.size(); ++t) instances += instanced[t] ? plan.copies[t] : 0;
  if (instances >= kNoIndex) throw InputError("the scene has too many instances");
  set_from_scene_.reserve(instances);
  instances_.reserve(instances);

  std::vector<std::uint32_t> copies_left(content.templates.size(), 0);
  for (std::size_t t = 0; t < copies_left.size(); ++t)
    copies_left[t] = static_cast<std::uint32_t>(std::min<std::uint64_t>(plan.copies[t], kNoIndex));
  walk.visit([&](const PlacedPiece& placed) {
    Body& body = content.templates[placed.of].body;
    Piece piece{placed.object,         placed.of, placed.materials, placed.first_patch, placed.first_analytic,
                placed.first_triangle, 0};
    const Transform centred_from_body = centred_from_scene * placed.scene_from_body;
    if (instanced[placed.of]) {
      if (objects_[placed.object].is_instance)
        objects_[placed.object].where = static_cast<std::uint32_t>(instances_.size());
      set_from_scene_.push_back(
          (centred_from_body * Transform::translation(body.centre_m - Point3{})).inverse());
      instances_.push_back(piece);
      return;
    }
    if (triangles_.facets.size() + body.mesh.triangles.size() >= kNoIndex)
      throw InputError("the scene has too many triangles");
    const auto owner = static_cast<std::uint32_t>(copies_.size());
    piece.set_triangle = is_chunked_[placed.of] ? 0 : static_cast<std::uint32_t>(triangles_.facets.size());
    piece.first_triangle -= piece.set_triangle;
    piece.first_analytic -= static_cast<std::uint32_t>(analytic_.shapes.size());
    copies_.push_back(piece);
    if (is_chunked_[placed.of]) {
      chunked_.push_back(std::make_unique<ChunkedMesh>(
          device_.get(), body.mesh, ChunkPlacement{centred_from_body, owner, true, box_padding_m()},
          late_failure_));
      storage_.stored_triangles += body.mesh.triangles.size();
      storage_.chunks += body.mesh.chunks.size();
    } else {
      triangles_.append(body, centred_from_body);
      triangles_.owners.resize(triangles_.facets.size(), owner);
    }
    analytic_.append(body, centred_from_body);
    analytic_.owners.resize(analytic_.shapes.size(), owner);
    copy_map_of_.push_back(kNoIndex);
    if (has_attributes(body.mesh)) {
      copy_map_of_.back() = static_cast<std::uint32_t>(body_from_scene_.size());
      body_from_scene_.push_back(placed.scene_from_body.inverse());
    }
    if (--copies_left[placed.of] > 0) return;
    if (has_attributes(body.mesh)) {
      attributes_of_[placed.of] = static_cast<std::uint32_t>(attributes_.size());
      attributes_.push_back({std::move(body.mesh), body.centre_m});
    }
    body.mesh = {};
  });
  if (attributes_.empty()) attributes_of_.clear();

  for (const Run& run : content.runs)
    if (content.templates[run.what.of].plane) {
      const Transform& map = run.what.whole_from_list;
      const Point3 at = map(Point3{0.0, 0.0, content.templates[run.what.of].plane->z_m});
      planes_.push_back(
          {at.z - centre_m_.z, run.first_object, content.materials[run.materials], map.inverse()});
    }

  instance_set_.targets.resize(content.templates.size());
  for (std::size_t t = 0; t < prototypes_.size(); ++t) {
    if (!prototypes_[t]) continue;
    const Body& body = content.templates[t].body;
    instance_set_.targets[t] = {prototypes_[t]->scene.get(),
                                image_of(body.bounds, Transform::translation(Point3{} - body.centre_m))};
  }
}

void EmbreeWorld::place_fields(const WorldContent& content) {
  const Transform centred_from_scene = Transform::translation(Point3{} - centre_m_);
  for (const Run& run : content.runs) {
    const auto& field = content.templates[run.what.of].field;
    if (!field) continue;
    const Transform centred_from_field =
        centred_from_scene * run.what.whole_from_list * field->object_from_field();
    fields_.push_back({field, centred_from_field, centred_from_field.inverse(), box_padding_m(),
                       run.first_object, content.materials[run.materials]});
  }
}

void EmbreeWorld::build_scene(InstanceStorage storage) {
  if (instances_.empty() && triangles_.facets.empty() && chunked_.empty() && analytic_.shapes.empty() &&
      fields_.empty())
    return;
  storage_.stored_triangles += triangles_.facets.size();
  storage_.instances = instances_.size();
  storage_.instance_table = storage == InstanceStorage::table ||
                            (storage == InstanceStorage::by_number && instances_.size() > kMostNodes);
  analytic_.padding_m = instance_set_.padding_m = box_padding_m();
  scene_ = make_scene(device_.get(), true);
  auto next = static_cast<unsigned>(storage_.instance_table ? 0 : instances_.size());
  if (storage_.instance_table && !instances_.empty()) {
    instance_set_.set_from_scene = &set_from_scene_;
    instance_set_.pieces = &instances_;
    attach_instance_set(device_.get(), scene_.get(), next++, instance_set_);
  } else {
    for (unsigned i = 0; i < next; ++i)
      attach_instance(device_.get(), scene_.get(), i, prototypes_[instances_[i].of]->scene.get(),
                      set_from_scene_[i].inverse());
  }
  if (!triangles_.facets.empty()) attach_triangles(device_.get(), scene_.get(), next, triangles_);
  if (!analytic_.shapes.empty()) attach_analytic(device_.get(), scene_.get(), next + 1, analytic_);
  next += 2;
  for (const PlacedField& field : fields_) attach_field(device_.get(), scene_.get(), next++, field);
  for (const auto& mesh : chunked_) mesh->attach_to(scene_.get(), next++);
  commit(device_.get(), scene_.get());
}

void EmbreeWorld::note_storage(const PrototypePlan& plan) {
  storage_.prototypes_apart = plan.apart;
  built_embree_bytes_ = embree_bytes_;
  storage_.bytes = static_cast<std::size_t>(std::max<std::int64_t>(0, built_embree_bytes_)) +
                   triangles_.bytes() + bytes_of(analytic_) + bytes_of(objects_) + bytes_of(transforms_) +
                   bytes_of(set_from_scene_) + bytes_of(instances_) + bytes_of(copies_) +
                   bytes_of(materials_) + bytes_of(body_from_scene_);
  for (const PlacedField& field : fields_) storage_.bytes += field.field->bytes();
  if (!storage_.instance_table) storage_.bytes += kUnseenNodeBytes * instances_.size();
  for (const auto& prototype : prototypes_)
    if (prototype) storage_.bytes += prototype->triangles.bytes() + bytes_of(prototype->analytic);
}

World::Storage EmbreeWorld::storage() const {
  Storage now = storage_;
  const auto add = [&](const ChunkedMesh& mesh) {
    const ChunkedMesh::Made made = mesh.made();
    now.chunks_made += made.chunks;
    now.chunk_bytes += made.triangle_bytes;
  };
  for (const auto& mesh : chunked_) add(*mesh);
  for (const auto& prototype : prototypes_)
    if (prototype && prototype->chunked) add(*prototype->chunked);
  if (now.chunks_made > 0)
    now.chunk_bytes +=
        static_cast<std::size_t>(std::max<std::int64_t>(0, embree_bytes_ - built_embree_bytes_));
  return now;
}

}  // namespace ifov::geometry
