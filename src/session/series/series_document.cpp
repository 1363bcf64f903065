#include "session/series/series_document.h"

#include "core/error.h"
#include "io/document/document.h"
#include "session/shared_scene.h"

namespace ifov::session {

std::vector<std::string> shown_channels(const io::Document& document) {
  std::vector<std::string> names;
  for (const io::DocumentName& channel : document.output.quicklook_channels) names.push_back(channel.name);
  return names;
}

bool is_of_views(const io::Document& document) {
  const std::string& model = document.sensor.camera.model;
  return model == "points" || model == "rays";
}

void refuse_what_is_still(const io::Document& document) {
  if (document.weather || document.scene.origin.geographic || document.platform ||
      !SharedScene::serves(document))
    return;
  throw InputError(format(
      "{}: nothing in it changes with the time: it has no \"weather\", no object with \"present\", and no latitude and "
      "longitude in its \"origin\", from which it follows where the Sun stands",
      document.sources.file_name));
}

}  // namespace ifov::session
