#include "apps/view/request_guard.h"

#include <algorithm>

#include <fmt/format.h>

namespace depthmocap {
namespace {

constexpr std::string_view kBearer = "Bearer ";

// Takes the same time wherever the first difference is.
bool sameToken(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i) {
    difference |= static_cast<unsigned>(static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i]));
  }
  return difference == 0;
}

bool isOwnLoopbackName(std::string_view host, const GuardConfig& config) {
  for (const std::string& name : {hostName(config.address), std::string("localhost")}) {
    if (host == fmt::format("{}:{}", name, config.port)) return true;
    if (config.port == 80 && host == name) return true;
  }
  return false;
}

}  // namespace

std::string hostName(std::string_view address) {
  return address.find(':') == std::string_view::npos ? std::string(address) : fmt::format("[{}]", address);
}

bool isToken(std::string_view text) {
  constexpr std::size_t kLongest = 128;
  constexpr std::string_view kSigns = "-._~";
  return !text.empty() && text.size() <= kLongest && std::ranges::all_of(text, [&](char c) {
    const auto lower = static_cast<char>(c | 0x20);
    return (c >= '0' && c <= '9') || (lower >= 'a' && lower <= 'z') || kSigns.find(c) != std::string_view::npos;
  });
}

bool isOrigin(std::string_view text) {
  constexpr std::size_t kLongest = 256;
  constexpr std::string_view kSigns = "-._:[]";
  const std::size_t colon = text.find("://");
  if (colon == std::string_view::npos) return false;
  if (text.size() > kLongest || (text.substr(0, colon) != "http" && text.substr(0, colon) != "https")) return false;
  const std::string_view host = text.substr(colon + 3);
  return !host.empty() && std::ranges::all_of(host, [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || kSigns.find(c) != std::string_view::npos;
  });
}

bool isAllowedOrigin(std::string_view origin, const GuardConfig& config) {
  return std::ranges::find(config.allowed_origins, origin) != config.allowed_origins.end();
}

std::string_view pathOf(std::string_view target) {
  return target.substr(0, target.find('?'));
}

std::string_view queryValue(std::string_view target, std::string_view key) {
  const std::size_t question = target.find('?');
  if (question == std::string_view::npos) return {};
  std::string_view query = target.substr(question + 1);
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    if (pair.size() > key.size() && pair.substr(0, key.size()) == key && pair[key.size()] == '=') {
      return pair.substr(key.size() + 1);
    }
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
  }
  return {};
}

bool isLoopback(std::string_view address) {
  return address.substr(0, 4) == "127." || address == "::1";
}

std::string refusal(const RequestClaim& claim, const GuardConfig& config) {
  if (claim.host.empty()) return "the request names no host";
  if (isLoopback(config.address) && !isOwnLoopbackName(claim.host, config)) {
    return "this server answers only to its own address and localhost";
  }
  const bool own_page = claim.origin.empty() || claim.origin == fmt::format("http://{}", claim.host);
  if (!own_page && !isAllowedOrigin(claim.origin, config)) {
    return "pages of other origins are not answered; --allow-origin lets one in";
  }
  if (config.token.empty() || claim.preflight) return {};
  std::string_view given = queryValue(claim.target, "token");
  if (claim.authorization.substr(0, kBearer.size()) == kBearer) given = claim.authorization.substr(kBearer.size());
  if (!sameToken(given, config.token)) return "the token is missing or wrong";
  return {};
}

}  // namespace depthmocap
