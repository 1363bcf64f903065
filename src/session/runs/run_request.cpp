#include "core/format.h"
#include "io/document/document.h"
#include "io/files/own_files.h"
#include "session/loaded/parts.h"
#include "session/runs/run.h"

namespace ifov::session {

std::filesystem::path RunRequest::folder(const Session& session) const {
  if (!options.output_folder.empty()) return options.output_folder;
  const io::Document& document = session.parts().document;
  std::filesystem::path folder = document.output.folder;
  if (!share.is_whole()) folder += format(".{}-of-{}", share.number, share.count);
  // It stands beside the document, perhaps in somebody's archive; a folder that the user gives may be a link.
  io::refuse_links_below(std::filesystem::path(document.sources.file_name).parent_path(), folder);
  return folder;
}

}  // namespace ifov::session
