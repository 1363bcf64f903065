#pragma once

#include <string>
#include <string_view>

namespace ifov::viewer {

/// 128 bits of the system's random numbers, 32 hexadecimal digits. Throws SystemError.
std::string new_token();

/// The token in a file of the user's own: one line of 22 to 128 letters, digits, '-' and '_'. Throws InputError where it holds
/// anything else or others may read it, SystemError where it cannot be read.
std::string token_in(const std::string& file);

/// Whether an address is of this machine alone: 127.0.0.0/8, ::1 or localhost.
bool is_loopback(std::string_view address);

/// What a request says of where it comes from; texts that it lacks are empty.
struct Origin {
  std::string method, host, origin, fetch_site, token;
  int hosts = 1;  ///< how many Host headers
};

/// Whether a request may be answered at all, and whether with what is the user's.
class Guard {
 public:
  /// `address`: where the server listens.
  Guard(std::string token, std::string address);

  /// Status and reason of a refusal; status 0: none. A page of another site gets nothing (its name stands in Host where it points
  /// at this machine, in Origin and Sec-Fetch-Site where it asks across), nor does who has no token, but for the page itself.
  struct Verdict {
    int status = 0;
    std::string why;
  };
  /// `method`: the one that what is asked for takes.
  Verdict judge(const Origin& request, bool needs_token, std::string_view method) const;

 private:
  bool is_own_host(std::string_view host) const;

  std::string token_, address_;
};

}  // namespace ifov::viewer
