#include "ifov/check.h"

#include <mutex>
#include <sstream>

namespace ifov {
namespace {

/// Passes on what is said, and keeps the warnings also of a scene that cannot be loaded.
class WarningsKept final : public LogSink {
 public:
  WarningsKept(LogSink* next, std::vector<Message>& messages) : next_(next), messages_(messages) {}
  void info(const std::string& message) override {
    if (next_ != nullptr) next_->info(message);
  }
  void warn(const std::string& message) override {
    {
      const std::scoped_lock lock(mutex_);
      messages_.push_back({Severity::warning, message, {}});
    }
    if (next_ != nullptr) next_->warn(message);
  }

 private:
  LogSink* next_;
  std::mutex mutex_;
  std::vector<Message>& messages_;
};

}  // namespace

std::vector<Message> check(const Document& document, const LoadOptions& options) {
  std::vector<Message> messages;
  WarningsKept log(options.log, messages);
  LoadOptions load = options;
  load.log = &log;
  try {
    std::istringstream lines(Simulation::load(document, load).description());
    for (std::string line; std::getline(lines, line);) messages.push_back({Severity::statement, line, {}});
  } catch (const InputError& error) {
    messages.push_back({Severity::error, error.what(), error.position()});
  } catch (const SystemError& error) {
    messages.push_back({Severity::failure, error.what(), {}});
  }
  return messages;
}

}  // namespace ifov
