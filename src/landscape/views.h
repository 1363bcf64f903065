#pragma once

#include <string>
#include <vector>

#include "landscape/landscapes.h"
#include "landscape/output/scene_folder.h"
#include "landscape/output/scene_maker.h"

namespace ifov::landscape {

/// Where the sun stands and where the oblique view looks from.
struct ViewChoice {
  std::string title;               ///< of the scene, for the top of its documents
  double eye_azimuth_deg = 205.0;  ///< of the oblique camera, seen from the middle
  double eye_height_share = 0.42;  ///< of the size
  std::string surroundings =
      "grass, pasture";  ///< material of the built-in library that goes on to the horizon
  int surroundings_c = 27;
  std::string air = "mid-latitude summer";  ///< model atmosphere
  std::string haze = "rural";               ///< type of aerosol
};

/// The light of all generated scenes: the Sun's disc 35 degrees from the zenith in the south-east, through a model
/// atmosphere with a visibility of 23 km.
io::LightDocument clear_day(const ViewChoice& choice, SceneFolder& folder);
io::AtmosphereDocument clear_air(const ViewChoice& choice);

/// Writes the documents, which differ in what looks at the scene alone, and publishes the folder:
/// `quicklook.json`, `oblique.json`, `render_vswir.json`, `render_thermal.json`.
MadeScene finish_scene(const MakeOptions& options, const ViewChoice& choice, const SceneMaker& scene,
                       SceneFolder& folder, std::vector<std::string> contents);

/// Throws InputError unless the size is between kSmallest_m and kLargest_m.
void check_size(double size_m);

}  // namespace ifov::landscape
