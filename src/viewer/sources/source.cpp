#include "viewer/sources/source.h"

#include "core/error.h"
#include "io/files/input_file.h"
#include "viewer/sources/open_run.h"
#include "viewer/sources/run_watch.h"

namespace ifov::viewer {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{300};

}  // namespace

CheckedDocument::CheckedDocument(const std::filesystem::path& file, const std::vector<std::string>& set)
    : file_(file), set_(set), call_(current_call()) {
  state_.file = file.string();
  state_.text = io::read_input(file);
  try {
    output_folder_ = Document::read(file, set).output_folder();
  } catch (const std::exception&) {
    // The checks say what is wrong.
  }
}

void CheckedDocument::begin() {
  const std::lock_guard lock(mutex_);
  if (checks_.joinable()) return;
  checks_ = std::thread([this] {
    const CallScope scope(call_);
    std::vector<Message> messages;
    try {
      messages = check(Document::read(file_, set_), {.scene_cache = true, .cancel = &cancel_});
    } catch (const InputError& error) {
      messages.push_back({Severity::error, error.what(), error.position()});
    } catch (const Cancelled&) {
      return;
    } catch (const std::exception& error) {
      messages.push_back({Severity::failure, error.what(), {}});
    }
    const std::lock_guard told(mutex_);
    state_.messages = std::move(messages);
    state_.checked = true;
  });
}

CheckedDocument::~CheckedDocument() {
  cancel_.cancel();
  if (checks_.joinable()) checks_.join();
}

CheckedDocument::State CheckedDocument::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::filesystem::path CheckedDocument::output_folder() const { return output_folder_; }

Source::Now Source::now() {
  const std::lock_guard lock(mutex_);
  const auto time = std::chrono::steady_clock::now();
  if (!has_looked_ || time - looked_ > kBetweenLooks) {
    look();
    looked_ = std::chrono::steady_clock::now();
    has_looked_ = true;
  }
  return now_;
}

void Source::look() {
  now_.watch.reset();
  now_.fault.clear();
  try {
    if (holds_unfinished_run(folder_)) now_.watch = std::make_shared<const RunWatch>(folder_);
  } catch (const std::exception& error) {
    // A run that begins or ends at this moment: its state is half there.
    now_.fault = error.what();
  }
  const std::string signature = signature_of(folder_);
  if (signature.empty()) {
    if (now_.run)
      now_.fault = format(
          "{}: the products are gone, or are being made anew; what is shown are those that were "
          "there",
          folder_.string());
    else if (!now_.watch && now_.fault.empty())
      now_.fault = format("{}: there are no products and no run yet", folder_.string());
    return;
  }
  if (signature == signature_ && now_.run) return;
  try {
    now_.run = open_run(folder_);
    ++now_.generation;
    signature_ = signature;
  } catch (const std::exception& error) {
    if (!now_.watch) now_.fault = error.what();
  }
}

}  // namespace ifov::viewer
