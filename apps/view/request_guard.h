#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace depthmocap {

// What a request says about itself; empty where a field is missing.
struct RequestClaim {
  std::string_view target = {};  // path and query
  std::string_view host = {};
  std::string_view origin = {};
  std::string_view authorization = {};
  bool preflight = false;  // a browser asks whether a page may ask; it sends no token with that
};

struct GuardConfig {
  std::string address = "127.0.0.1";  // that the server listens on
  std::uint16_t port = 0;
  std::string token = {};                         // empty: none is asked for
  std::vector<std::string> allowed_origins = {};  // of pages besides its own that may use the server (isOrigin())
};

// Why a request must not be answered; empty if it may. Host names other than the server's own are refused on loopback
// (DNS rebinding), origins that are neither its own nor allowed, and a missing or wrong token where one is asked for.
std::string refusal(const RequestClaim& claim, const GuardConfig& config);

// Whether a text is the origin of a page as browsers send it: scheme://host[:port] in small letters. "*" is none: pages
// are let in by name.
bool isOrigin(std::string_view text);
// Whether a page of this origin was let in by name.
bool isAllowedOrigin(std::string_view origin, const GuardConfig& config);

// "/a/b" of "/a/b?c=d".
std::string_view pathOf(std::string_view target);
// The value of a key in the query; values are taken as they stand.
std::string_view queryValue(std::string_view target, std::string_view key);

// A numeric address as it stands in a URL: [::1] of ::1.
std::string hostName(std::string_view address);
// Whether a text can be a token: at most 128 letters, digits and -._~, which stand in a URL as they are.
bool isToken(std::string_view text);

// Whether a numeric address is one of 127.0.0.0/8 or ::1.
bool isLoopback(std::string_view address);

}  // namespace depthmocap
