#include "viewer/http/guard.h"

#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "io/files/input_file.h"

namespace ifov::viewer {
namespace {

bool is_token_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; }

/// Takes as long whatever the texts have in common.
bool same(std::string_view a, std::string_view b) {
  unsigned char differences = a.size() == b.size() ? 0 : 1;
  for (std::size_t k = 0; k < b.size(); ++k)
    differences |= static_cast<unsigned char>((k < a.size() ? a[k] : 0) ^ b[k]);
  return differences == 0;
}

/// "[::1]:80" and "name:80" without the port.
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

bool is_dotted_loopback(std::string_view address) {
  return address.starts_with("127.") && address.find_first_not_of("0123456789.") == std::string_view::npos &&
         std::count(address.begin(), address.end(), '.') == 3;
}

}  // namespace

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw SystemError("the system gives no random numbers");
  std::string token;
  for (const unsigned char byte : bytes) token += format("{:02x}", byte);
  return token;
}

std::string token_in(const std::string& file) {
  const io::InputFile opened(file);
  struct stat status {};
  if (fstat(opened.descriptor(), &status) == 0 && (status.st_mode & 077) != 0)
    throw InputError(format("{}: others may read this file; a token is the user's alone (chmod 600)", file));
  std::string token = opened.size() > 4096 ? std::string() : opened.text();
  while (!token.empty() && std::isspace(static_cast<unsigned char>(token.back()))) token.pop_back();
  if (token.size() < 22 || token.size() > 128 || !std::all_of(token.begin(), token.end(), is_token_letter))
    throw InputError(
        format("{}: expected one line of 22 to 128 letters, digits, '-' and '_'; "
               "'openssl rand -hex 16' makes one",
               file));
  return token;
}

bool is_loopback(std::string_view address) {
  return is_dotted_loopback(address) || address == "::1" || address == "localhost";
}

Guard::Guard(std::string token, std::string address)
    : token_(std::move(token)), address_(std::move(address)) {}

bool Guard::is_own_host(std::string_view host) const {
  // Any port: a tunnel (ssh -L) may have another one at its end.
  const std::string_view name = without_port(host);
  return name == "localhost" || is_dotted_loopback(name) || name == "[::1]" || name == address_ ||
         name == "[" + address_ + "]";
}

Guard::Verdict Guard::judge(const Origin& request, bool needs_token, std::string_view method) const {
  if (request.method != method) return {405, "only " + std::string(method) + " is answered"};
  if (request.hosts != 1 || !is_own_host(request.host))
    return {421, "the request is meant for another host than this server's"};
  if (!request.origin.empty() && request.origin != "http://" + request.host)
    return {403, "pages of other sites are not answered"};
  if (!request.fetch_site.empty() && request.fetch_site != "same-origin" && request.fetch_site != "none")
    return {403, "pages of other sites are not answered"};
  if (needs_token && !same(request.token, token_))
    return {403, "the token is missing or wrong; open the address that 'ifov view' has printed"};
  return {};
}

}  // namespace ifov::viewer
