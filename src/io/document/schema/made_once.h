#pragma once

#include <map>
#include <mutex>

namespace ifov::io {

/// make(of), made once for each `of`: a table of keys that a hundred rows of others share takes a millisecond. Threads may ask at once;
/// make() asks for others alone.
template <auto make, class Of>
auto made_once(Of of) {
  static std::mutex mutex;
  static std::map<Of, decltype(make(of))> made;
  const std::scoped_lock lock(mutex);
  const auto known = made.find(of);
  return known != made.end() ? known->second : made.emplace(of, make(of)).first->second;
}

}  // namespace ifov::io
