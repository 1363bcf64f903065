#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

struct GlintPoint;

/// From where light is sought by the shapes of what throws it. A camera that stands still while it is exposed seeks once. One that flies
/// seeks from where it is at instants of its exposure, drawn apart for each replicate, so that their spread holds what lies between
/// instants.
class SoughtInstants {
 public:
  /// Keeps a reference to the camera.
  SoughtInstants(const scene::Scene& scene, const sensor::Camera& camera, std::uint64_t seed);
  ~SoughtInstants();

  std::size_t size() const { return times_s_.empty() ? 1 : times_s_.size(); }
  const sensor::Camera& camera(std::size_t k) const;
  std::uint64_t seed(std::size_t k) const;
  /// What is found from there, as a point of the whole exposure.
  GlintPoint point(std::size_t k, GlintPoint found) const;

 private:
  const sensor::Camera& camera_;
  std::uint64_t seed_;
  std::vector<double> times_s_;  // after the middle of the exposure; empty: the camera stands still
  std::vector<std::unique_ptr<const sensor::Camera>> cameras_;
};

/// At which rays of a lattice are asked for the same, after the middle of the exposure: 0 alone of a camera that stands still.
std::vector<double> lattice_times_s(const sensor::Camera& camera);

}  // namespace ifov::render
