#include "geometry/world/chunked_mesh.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/call_scope.h"
#include "core/run_apart.h"
#include "geometry/world/flush_denormals.h"
#include "geometry/world/instance_set.h"
#include "geometry/world/ray_packet.h"

namespace ifov::geometry {
namespace {

void bound_chunk(const RTCBoundsFunctionArguments* a) {
  const WithinCommit order;
  const auto& mesh = *static_cast<const ChunkedMesh*>(a->geometryUserPtr);
  *a->bounds_o = padded(mesh.chunk_bounds(a->primID), mesh.padding_m());
}

// Embree hands over its own packet, whose layout is that of the calls for eight rays.

void intersect_chunk(const RTCIntersectFunctionNArguments* a) {
  const RTCScene tree = static_cast<const ChunkedMesh*>(a->geometryUserPtr)->tree(a->primID);
  if (tree != nullptr) rtcIntersect8(a->valid, tree, a->context, reinterpret_cast<RTCRayHit8*>(a->rayhit));
}

void occlude_chunk(const RTCOccludedFunctionNArguments* a) {
  const RTCScene tree = static_cast<const ChunkedMesh*>(a->geometryUserPtr)->tree(a->primID);
  if (tree != nullptr) rtcOccluded8(a->valid, tree, a->context, reinterpret_cast<RTCRay8*>(a->ray));
}

}  // namespace

void LateFailure::note(std::exception_ptr failure) {
  const std::lock_guard lock(mutex_);
  if (!first_) first_ = std::move(failure);
  any_.store(true, std::memory_order_release);
}

void LateFailure::rethrow() const {
  const std::lock_guard lock(mutex_);
  std::rethrow_exception(first_);
}

ChunkedMesh::ChunkedMesh(RTCDevice device, MeshLists mesh, const ChunkPlacement& placement,
                         LateFailure& failure)
    : device_(device),
      mesh_(std::move(mesh)),
      placement_(placement),
      failure_(failure),
      chunks_(std::make_unique<Chunk[]>(mesh_.chunks.size())) {}

void ChunkedMesh::attach_to(RTCScene scene, unsigned geometry) const {
  RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(mesh_.chunks.size()));
  rtcSetGeometryUserData(g, const_cast<ChunkedMesh*>(this));
  rtcSetGeometryBoundsFunction(g, bound_chunk, nullptr);
  rtcSetGeometryIntersectFunction(g, intersect_chunk);
  rtcSetGeometryOccludedFunction(g, occlude_chunk);
  attach(device_, scene, g, geometry);
}

World::Bounds ChunkedMesh::chunk_bounds(std::size_t chunk) const {
  return image_of(mesh_.chunks[chunk].bounds, placement_.set_from_object);
}

ChunkedMesh::Made ChunkedMesh::made() const {
  Made result;
  for (std::size_t k = 0; k < mesh_.chunks.size(); ++k) {
    if (chunks_[k].scene.load(std::memory_order_acquire) == nullptr) continue;
    ++result.chunks;
    result.triangle_bytes += chunks_[k].tree->triangles.bytes();
  }
  return result;
}

RTCScene ChunkedMesh::tree(std::size_t chunk) const {
  Chunk& c = chunks_[chunk];
  if (const RTCScene made = c.scene.load(std::memory_order_acquire)) return made;
  const std::lock_guard lock(c.mutex);
  if (c.tree) return c.tree->scene.get();
  try {
    run_apart([&] { c.tree = make_tree(chunk); });
  } catch (...) {
    failure_.note(std::current_exception());
    return nullptr;
  }
  c.scene.store(c.tree->scene.get(), std::memory_order_release);
  return c.tree->scene.get();
}

std::unique_ptr<ChunkedMesh::Tree> ChunkedMesh::make_tree(std::size_t chunk) const {
  const KeepDenormals keep;  // as for trees that are made before any ray
  // The tree outlives the call whose ray came first, and is made whole even if that call is cancelled.
  const Call whole{current_call().inputs, nullptr};
  const CallScope scope(whole);
  const MeshChunk& c = mesh_.chunks[chunk];
  auto tree = std::make_unique<Tree>();
  tree->triangles.take(mesh_, mesh_.order.subspan(c.first, c.count), placement_.set_from_object);
  tree->triangles.only_owner = placement_.owner;
  tree->scene = make_scene(device_, placement_.robust);
  attach_triangles(device_, tree->scene.get(), 0, tree->triangles);
  commit(device_, tree->scene.get());
  return tree;
}

}  // namespace ifov::geometry
