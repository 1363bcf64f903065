#include "studies/suburb_scene.h"

namespace ifov::studies {

io::Document suburb_document(const StudyOptions& options, bool quick) {
  (void)quick;
  return io::read_document(options.scene.string());
}

}  // namespace ifov::studies
