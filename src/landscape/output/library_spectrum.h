#pragma once

#include <string>
#include <string_view>

#include "io/document/spectrum_document.h"
#include "landscape/output/scene_folder.h"

namespace ifov::landscape {

enum class LeafColumn { reflectance = 2, transmittance = 3 };

/// A curve (counted from 1) of the built-in spectral library, as a file of the scene, `spectra/<name>_<curve>.csv`, to
/// be read and edited; returns the spectrum as a document names it.
io::SpectrumDocument library_spectrum(std::string_view material, int curve, SceneFolder& folder,
                                      LeafColumn column = LeafColumn::reflectance);

}  // namespace ifov::landscape
