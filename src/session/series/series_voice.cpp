#include "session/series/series_voice.h"

#include <algorithm>

#include "core/format.h"

namespace ifov::session {

void SeriesLog::info(const std::string& message) {
  if (next_ != nullptr) next_->info(message);
}

void SeriesLog::warn(const std::string& message) {
  {
    const std::scoped_lock lock(mutex_);
    if (!warned_.insert(message).second) return;
  }
  if (next_ != nullptr) next_->warn(message);
}

std::size_t SeriesLog::warnings() const {
  const std::scoped_lock lock(mutex_);
  return warned_.size();
}

void SeriesProgress::time(std::size_t number, const std::string& name, std::size_t more) {
  const std::scoped_lock lock(mutex_);
  number_ = number, name_ = name, more_ = more, rendering_ = false;
  before_ = shown_;
}

void SeriesProgress::report(const Progress& progress) {
  const std::scoped_lock lock(mutex_);
  if (!rendering_) {
    if (next_ != nullptr) next_->report(progress);
    return;
  }
  shown_.pixels_done = before_.pixels_done + progress.pixels_done;
  shown_.pixels_converged = before_.pixels_converged + progress.pixels_converged;
  shown_.rays = before_.rays + progress.rays;
  shown_.worst_error_ratio = std::max(before_.worst_error_ratio, progress.worst_error_ratio);
  // Every time has as many pixels.
  shown_.pixels_total = before_.pixels_done + progress.pixels_total * static_cast<std::int64_t>(1 + more_);
  shown_.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (next_ != nullptr) next_->report(shown_);
}

void SeriesProgress::phase(const std::string& what) {
  const std::scoped_lock lock(mutex_);
  rendering_ = what.empty();
  if (next_ != nullptr)
    next_->phase(what.empty() ? format("{} ({} of {})", name_, number_ + 1, times_)
                              : format("{} ({} of {}): {}", name_, number_ + 1, times_, what));
}

}  // namespace ifov::session
