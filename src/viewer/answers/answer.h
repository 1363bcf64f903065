#pragma once

#include <functional>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::viewer {

/// What a request asks for beside its path: names and values as they came. All is checked where it is taken.
class Query {
 public:
  /// `nobody_waits` may be empty: somebody does.
  explicit Query(std::map<std::string, std::string> values, std::function<bool()> nobody_waits = {})
      : values_(std::move(values)), nobody_waits_(std::move(nobody_waits)) {}

  /// A whole number in [low, high]. Throws Refused (400), which says what was found and expected; so do the others.
  int integer(const std::string& name, int low, int high) const;
  int integer(const std::string& name, int low, int high, int otherwise) const;
  /// A number in [low, high], written in decimals.
  double number(const std::string& name, double low, double high) const;
  /// At most `most` bytes.
  std::string text(const std::string& name, std::size_t most) const;
  /// One of these.
  std::string choice(const std::string& name, std::span<const std::string_view> choices) const;
  bool has(const std::string& name) const { return values_.contains(name); }

  /// Whether the client has gone, or the server ends: work for this answer may stop. Costs microseconds; from any thread.
  bool nobody_waits() const { return nobody_waits_ && nobody_waits_(); }

 private:
  const std::string& value(const std::string& name) const;

  std::map<std::string, std::string> values_;
  std::function<bool()> nobody_waits_;
};

struct Answer {
  std::string type = "application/json", body = {};
  std::string about = {};  ///< JSON on one line, ASCII: what the numbers of a binary body are; empty: none
};

/// A request that is not answered: an HTTP status and why, in words.
class Refused : public std::runtime_error {
 public:
  Refused(int status, const std::string& why) : std::runtime_error(why), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

/// The body of such an answer, as JSON.
std::string why_refused(const std::string& why);

/// Where the k-th of every `step` places stands among `count`: in the middle of its step.
std::size_t thinned_place(std::size_t k, std::size_t step, std::size_t count);

/// Little-endian floats.
Answer numbers(std::span<const float> values, std::string about);

}  // namespace ifov::viewer
