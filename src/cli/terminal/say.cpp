#include "cli/terminal/say.h"

#include <cstdio>

#include "core/printable.h"

namespace ifov::cli {

void say(const std::string& text) { std::fputs(printable(text).c_str(), stdout); }

void complain(const std::string& message) {
  std::fprintf(stderr, "%s\n", printable_message(message).c_str());
}

}  // namespace ifov::cli
