#include "guard.h"

#include <arpa/inet.h>

#include <random>

namespace inkgrid::studio {
namespace {

bool is_address(const std::string& name) {
  unsigned char address[sizeof(in6_addr)];
  if (name.size() > 2 && name.front() == '[' && name.back() == ']')
    return ::inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), address) == 1;
  return ::inet_pton(AF_INET, name.c_str(), address) == 1;
}

// A name that another site's owner can't point at this machine: a number, or localhost.
bool is_own_host(const std::string& host, int port) {
  const std::string suffix = ":" + std::to_string(port);
  if (!host.ends_with(suffix)) return false;
  const std::string name = host.substr(0, host.size() - suffix.size());
  return name == "localhost" || is_address(name);
}

bool needs_token(const std::string& path) {
  return path.starts_with("/api/");
}

}  // namespace

std::string random_token() {
  constexpr std::string_view digits = "0123456789abcdef";
  std::random_device random;
  std::string token;
  for (int word = 0; word < 4; ++word) {
    const unsigned int bits = random();
    for (int shift = 0; shift < 32; shift += 4) token += digits[bits >> shift & 15U];
  }
  return token;
}

bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned int difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

std::optional<std::string> refusal(const Asked& asked, const Guard& guard) {
  if (!is_own_host(asked.host, guard.port)) return "this server answers to its own address only";
  if (!asked.origin.empty() && asked.origin != "http://" + asked.host) return "other sites may not ask this server";
  const bool navigation = asked.fetch_site == "none";
  const bool foreign = !asked.fetch_site.empty() && asked.fetch_site != "same-origin" && !navigation;
  if (foreign && asked.path != "/") return "other sites may not ask this server";
  if (needs_token(asked.path) && !same_token(asked.token, guard.token))
    return "the token is wrong: please open the address that the program printed";
  return std::nullopt;
}

const std::vector<std::pair<std::string, std::string>>& safety_headers() {
  static const std::vector<std::pair<std::string, std::string>> headers{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; base-uri 'none'; "
       "form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"},
  };
  return headers;
}

}  // namespace inkgrid::studio
