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
  times(number, 1, name, more);
}

void SeriesProgress::times(std::size_t first, std::size_t together, const std::string& name,
                           std::size_t more) {
  const std::scoped_lock lock(mutex_);
  number_ = first, together_ = together, name_ = name, more_ = more, rendering_ = false;
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
  shown_.pixels_total = before_.pixels_done + progress.pixels_total *
                                                  static_cast<std::int64_t>(together_ + more_) /
                                                  static_cast<std::int64_t>(together_);
  shown_.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (next_ != nullptr) next_->report(shown_);
}

void SeriesProgress::phase(const std::string& what) {
  const std::scoped_lock lock(mutex_);
  rendering_ = what.empty();
  if (next_ != nullptr)
    next_->phase(format("{} ({}{} of {}){}{}", name_, number_ + 1,
                        together_ > 1 ? format(" to {}", number_ + together_) : "", times_,
                        what.empty() ? "" : ": ", what));
}

class SumOfProgress::Part final : public ProgressSink {
 public:
  Part(SumOfProgress& sum, std::size_t number) : sum_(sum), number_(number) {}
  void report(const Progress& progress) override {
    const std::scoped_lock lock(sum_.mutex_);
    sum_.parts_[number_] = progress;
    Progress all;
    for (const Progress& part : sum_.parts_) {
      all.pixels_done += part.pixels_done;
      all.pixels_total += part.pixels_total;
      all.pixels_converged += part.pixels_converged;
      all.rays += part.rays;
      all.worst_error_ratio = std::max(all.worst_error_ratio, part.worst_error_ratio);
      all.elapsed_s = std::max(all.elapsed_s, part.elapsed_s);
    }
    sum_.to_.report(all);
  }

 private:
  SumOfProgress& sum_;
  std::size_t number_;
};

std::unique_ptr<ProgressSink> SumOfProgress::part() {
  parts_.emplace_back();
  return std::make_unique<Part>(*this, parts_.size() - 1);
}

}  // namespace ifov::session
