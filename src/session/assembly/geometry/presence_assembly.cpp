#include "session/assembly/geometry/presence_assembly.h"

#include "geodesy/utc_seconds.h"
#include "geometry/presence.h"
#include "io/document/presence_document.h"
#include "io/document/scene_document.h"

namespace ifov::session {

std::shared_ptr<const geometry::Presence> assemble_presence(const io::ObjectDocument& object,
                                                            const geodesy::UtcTime& time) {
  if (!object.present) return nullptr;
  geometry::Presence presence;
  for (const io::PresenceDocument::Interval& one : object.present->intervals)
    presence.intervals.push_back(
        {geodesy::seconds_after(one.begin, time), geodesy::seconds_after(one.end, time)});
  return std::make_shared<const geometry::Presence>(std::move(presence));
}

}  // namespace ifov::session
