#pragma once

#include <array>

#include "geodesy/attitude.h"
#include "io/document/schema/record.h"

namespace ifov::io {

/// `yaw`, `pitch` and `roll` of a member of the record, by default 0.
template <class T>
void add_angles(Record<T>& record, geodesy::Attitude T::*angles, const std::array<const char*, 3>& docs) {
  const auto angle = [angles](auto member) { return path(angles, member); };
  record.with_default("yaw", angle(&geodesy::Attitude::yaw_rad), quantity(kAngle), "\"0 deg\"", docs[0])
      .with_default("pitch", angle(&geodesy::Attitude::pitch_rad),
                    quantity(kAngle, Range::between(-90.0, 90.0, "deg")), "\"0 deg\"", docs[1])
      .with_default("roll", angle(&geodesy::Attitude::roll_rad), quantity(kAngle), "\"0 deg\"", docs[2]);
}

}  // namespace ifov::io
