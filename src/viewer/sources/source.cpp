#include "viewer/sources/source.h"

#include <algorithm>

#include "core/error.h"
#include "viewer/sources/open_run.h"
#include "viewer/sources/run_watch.h"

namespace ifov::viewer {
namespace {

// Tiles of a run at work are to be seen within a second; a run of very many of them is looked at less often.
constexpr std::chrono::milliseconds kBetweenLooks{200};
constexpr int kLookShare = 5;  // of the time one at most goes into looks

}  // namespace

Source::Now Source::now() {
  const std::lock_guard lock(mutex_);
  const auto time = std::chrono::steady_clock::now();
  if (time >= next_look_) {
    look();
    const auto end = std::chrono::steady_clock::now();
    next_look_ =
        end + std::max<std::chrono::steady_clock::duration>(kBetweenLooks, kLookShare * (end - time));
  }
  return now_;
}

void Source::close() {
  const std::lock_guard lock(mutex_);
  now_.run.reset();
  next_look_ = {};
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
    if (signature != signature_) ++now_.generation;
    signature_ = signature;
  } catch (const std::exception& error) {
    if (!now_.watch) now_.fault = error.what();
  }
}

}  // namespace ifov::viewer
