#pragma once

namespace ifov::io {

template <class T>
class Record;
struct SensorDocument;

/// The row of a sensor's own mounts.
void add_own_mounts(Record<SensorDocument>& record);

}  // namespace ifov::io
