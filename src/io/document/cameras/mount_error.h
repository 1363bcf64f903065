#pragma once

#include <string>
#include <utility>

#include "core/error.h"
#include "io/document/document_error.h"

namespace ifov::io {

/// A mount that cannot be had, or cannot turn as it should: what() has no place in the document, which is at mount().
class MountError : public InputError {
 public:
  MountError(const std::string& message, SourcePosition mount)
      : InputError(message), mount_(std::move(mount)) {}
  const SourcePosition& mount() const { return mount_; }

 private:
  SourcePosition mount_;
};

/// Runs `action`; what is wrong with a mount comes out as an error at that mount.
template <class Action>
auto with_mounts(const DocumentSources& sources, Action&& action) {
  try {
    return action();
  } catch (const MountError& error) {
    throw document_error(sources, error.mount(), error.what());
  }
}

}  // namespace ifov::io
