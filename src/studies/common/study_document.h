#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "io/document/sampling_document.h"
#include "io/document/scene_document.h"
#include "io/document/sensor_document.h"

namespace ifov::io {
struct AccuracySampling;
struct Document;
struct ErrorSize;
}  // namespace ifov::io

/// Documents as the studies write them.
namespace ifov::studies {

/// The document as a study keeps and renders it.
std::string study_text(const io::Document& document);

/// A document of a scene without light, seen from above.
io::Document nadir_document(io::CameraDocument camera, const std::string& channel, double wavelength_um,
                            io::SamplingDocument sampling, std::uint64_t seed);

/// A nadir camera with 1 m pixels whose image coordinates are (x, y) = (X - west, north - Y) of the ground
/// point.
io::CameraDocument nadir_camera(int width_px, int height_px, double west_m, double north_m);

/// The document's part of a way of sampling.
template <class Settings>
io::SamplingDocument sampling_of(Settings settings) {
  io::SamplingDocument sampling;
  sampling.method = std::make_shared<const Settings>(std::move(settings));
  return sampling;
}
io::SamplingDocument single_sampling();
io::SamplingDocument grid_sampling(int n);
/// The paper's scheme.
io::SamplingDocument adaptive_sampling(int sub_elements, int max_samples, io::ErrorSize allowed_difference);
/// `more` may change what else is asked.
io::SamplingDocument accuracy_sampling(io::ErrorSize error,
                                       const std::function<void(io::AccuracySampling&)>& more = nullptr);

io::MaterialDocument grey(const std::string& name, double reflectance);
io::MaterialDocument black(const std::string& name, io::TemperatureDocument temperature);
/// Of one material.
template <class Primitive>
io::ObjectDocument object_of(Primitive primitive, const std::string& material) {
  io::ObjectDocument object;
  object.shape = io::PrimitiveShape{std::string(Primitive::kModel.key),
                                    std::make_shared<const Primitive>(std::move(primitive))};
  object.material = io::MaterialBinding{io::DocumentName{material, {}}, {}};
  return object;
}

}  // namespace ifov::studies
