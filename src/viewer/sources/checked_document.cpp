#include "viewer/sources/checked_document.h"

#include <sys/stat.h>

#include "core/error.h"
#include "io/files/input_file.h"

namespace ifov::viewer {
namespace {

constexpr std::chrono::milliseconds kBetweenDocumentLooks{300};

/// Tells one content of a file from the next: editors write over it or put another in its place. Empty: there is none.
std::string document_signature(const std::filesystem::path& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) return {};
  return format("{} {} {} {}", found.st_ino, found.st_size, found.st_mtim.tv_sec, found.st_mtim.tv_nsec);
}

std::vector<Message> said_of(const std::filesystem::path& file, const std::vector<std::string>& set,
                             const CancelToken& cancel) {
  try {
    return check(Document::read(file, set), {.scene_cache = true, .cancel = &cancel});
  } catch (const InputError& error) {
    return {{Severity::error, error.what(), error.position()}};
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    return {{Severity::failure, error.what(), {}}};
  }
}

}  // namespace

CheckedDocument::CheckedDocument(const std::filesystem::path& file, const std::vector<std::string>& set)
    : file_(file), set_(set), call_(current_call()), signature_(document_signature(file)) {
  state_.file = file.string();
  state_.text = io::read_input(file);
  try {
    output_folder_ = Document::read(file, set).output_folder();
  } catch (const std::exception&) {
    // The checks say what is wrong.
  }
}

std::uint64_t CheckedDocument::look() {
  const std::lock_guard lock(mutex_);
  const auto time = std::chrono::steady_clock::now();
  if (time - looked_ < kBetweenDocumentLooks) return state_.version;
  looked_ = time;
  const std::string signature = document_signature(file_);
  // Between the old and the new there may be none, or one that cannot be read yet: the next look finds it.
  if (signature.empty() || signature == signature_) return state_.version;
  try {
    state_.text = io::read_input(file_);
  } catch (const std::exception&) {
    return state_.version;
  }
  signature_ = signature;
  ++state_.version;
  state_.checked = false;
  state_.messages.clear();
  if (cancel_) cancel_->cancel();
  cancel_.reset();
  return state_.version;
}

void CheckedDocument::begin() {
  const std::lock_guard lock(mutex_);
  if (cancel_) return;
  cancel_ = std::make_shared<CancelToken>();
  // Checks of an earlier version end first, not to load twice at a time.
  checks_ =
      std::thread([this, cancel = cancel_, version = state_.version, before = std::move(checks_)]() mutable {
        if (before.joinable()) before.join();
        const CallScope scope(call_);
        std::vector<Message> messages;
        try {
          messages = said_of(file_, set_, *cancel);
        } catch (const Cancelled&) {
          return;
        }
        const std::lock_guard told(mutex_);
        if (state_.version != version) return;
        state_.messages = std::move(messages);
        state_.checked = true;
      });
}

CheckedDocument::~CheckedDocument() {
  {
    const std::lock_guard lock(mutex_);
    if (cancel_) cancel_->cancel();
  }
  if (checks_.joinable()) checks_.join();
}

CheckedDocument::State CheckedDocument::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

}  // namespace ifov::viewer
