// What:   who may ask the server for anything.
// Source: ours, against pages of other sites in the same browser: cross-site requests, DNS rebinding, framing.
// Differs: nothing.
// Cost:   none.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace inkgrid::studio {

// 128 random bits as 32 hexadecimal digits.
std::string random_token();

// The same time whatever differs.
bool same_token(std::string_view a, std::string_view b);

// What a request says of where it comes from; empty where it says nothing.
struct Asked {
  std::string path;
  std::string host;        // "127.0.0.1:8080"
  std::string origin;      // "http://127.0.0.1:8080"
  std::string fetch_site;  // Sec-Fetch-Site: "same-origin", "none", "same-site", "cross-site"
  std::string token;
};

struct Guard {
  int port = 0;
  std::string token;
};

// Why a request is refused, in one sentence.  The page's own files need no token: they hold no secret.
std::optional<std::string> refusal(const Asked& asked, const Guard& guard);

// Sent with every answer.
const std::vector<std::pair<std::string, std::string>>& safety_headers();

}  // namespace inkgrid::studio
