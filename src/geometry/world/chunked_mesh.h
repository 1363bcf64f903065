#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>

#include "geometry/mesh_lists.h"
#include "geometry/world/embree_scene.h"
#include "geometry/world/primitive_sets.h"
#include "math/transform.h"

namespace ifov::geometry {

/// What went wrong while rays were under way: nothing can be thrown through Embree.
class LateFailure {
 public:
  void note(std::exception_ptr failure);
  void rethrow_if_any() const {
    if (any_.load(std::memory_order_acquire)) rethrow();
  }

 private:
  [[noreturn]] void rethrow() const;
  mutable std::mutex mutex_;
  std::exception_ptr first_;
  std::atomic<bool> any_{false};
};

/// How the triangles of a mesh get into a scene of Embree's.
struct ChunkPlacement {
  math::Transform set_from_object;
  std::uint32_t owner = 0;  ///< of a mesh in the scene itself
  bool robust = true;
  double padding_m = 0.0;  ///< by which boxes are widened against Embree's rounding
};

/// A divided mesh as one Embree geometry whose primitives are the boxes of its chunks. The first ray that enters a box
/// makes the tree of what is in it, others that come meanwhile wait for it; a chunk that no ray comes near costs its
/// box. What rays meet is what they would meet in one tree.
class ChunkedMesh {
 public:
  /// `device` and `failure` must outlive it.
  ChunkedMesh(RTCDevice device, MeshLists mesh, const ChunkPlacement& placement, LateFailure& failure);
  ChunkedMesh(const ChunkedMesh&) = delete;
  ChunkedMesh& operator=(const ChunkedMesh&) = delete;

  /// It must outlive the scene.
  void attach_to(RTCScene scene, unsigned geometry) const;

  const MeshLists& mesh() const { return mesh_; }
  const math::Transform& set_from_object() const { return placement_.set_from_object; }
  std::uint32_t owner() const { return placement_.owner; }
  World::Bounds chunk_bounds(std::size_t chunk) const;  ///< in the set's frame
  double padding_m() const { return placement_.padding_m; }

  /// Chunks whose trees are there by now, and the bytes of the trees' triangles.
  struct Made {
    std::size_t chunks = 0, triangle_bytes = 0;
  };
  Made made() const;

  /// The tree of a chunk; null where it could not be made, which is noted as a failure.
  RTCScene tree(std::size_t chunk) const;

 private:
  struct Tree {
    TriangleSet triangles;
    EmbreeScene scene;
  };
  struct Chunk {
    std::atomic<RTCScene> scene{nullptr};  ///< of the tree, once it is whole
    std::mutex mutex;
    std::unique_ptr<Tree> tree;
  };
  std::unique_ptr<Tree> make_tree(std::size_t chunk) const;

  RTCDevice device_;
  MeshLists mesh_;
  ChunkPlacement placement_;
  LateFailure& failure_;
  std::unique_ptr<Chunk[]> chunks_;
};

}  // namespace ifov::geometry
