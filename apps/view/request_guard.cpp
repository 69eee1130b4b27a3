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

bool isOwnLoopbackName(std::string_view host, std::uint16_t port) {
  for (const std::string_view name : {"127.0.0.1", "localhost", "[::1]"}) {
    if (host == fmt::format("{}:{}", name, port)) return true;
    if (port == 80 && host == name) return true;
  }
  return false;
}

}  // namespace

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
  if (config.loopback && !isOwnLoopbackName(claim.host, config.port)) {
    return "this server answers only to localhost";
  }
  if (!claim.origin.empty() && claim.origin != fmt::format("http://{}", claim.host)) {
    return "pages of other origins are not answered";
  }
  if (config.token.empty()) return {};
  std::string_view given = queryValue(claim.target, "token");
  if (claim.authorization.substr(0, kBearer.size()) == kBearer) given = claim.authorization.substr(kBearer.size());
  if (!sameToken(given, config.token)) return "the token is missing or wrong";
  return {};
}

}  // namespace depthmocap
