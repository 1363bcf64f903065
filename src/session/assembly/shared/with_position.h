#pragma once

#include "io/document/document_error.h"

namespace ifov::session {

/// Runs `action`; an error about something that the document names (a file that is not there, a mesh that is
/// broken, a spectrum with a gap) comes out as an InputError at that place of the document, with the cause's own
/// message in it, unless it has a place in the document already.
template <class Action>
auto with_position(const io::DocumentSources& sources, const SourcePosition& position, Action&& action) {
  try {
    return action();
  } catch (const InputError& error) {
    if (error.position().line > 0 && error.position().file == position.file) throw;
    throw io::document_error(sources, position, error.what());
  } catch (const SystemError& error) {
    throw io::document_error(sources, position, error.what());
  }
}

}  // namespace ifov::session
