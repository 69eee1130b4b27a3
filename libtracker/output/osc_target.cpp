#include "libtracker/output/osc_target.h"

#include <netdb.h>

#include "depthmocap/error.h"
#include "libtracker/core/parse_number.h"

namespace depthmocap {

OscTarget::OscTarget(const std::string& option, const std::string& target) {
  const auto fail = [&](const std::string& what) {
    throw Error(what, option + " " + target, "write HOST:PORT, for example localhost:39539");
  };
  const std::size_t colon = target.rfind(':');
  if (colon == std::string::npos || colon == 0) fail("no host and port");
  const auto port = parseInteger(target.substr(colon + 1));
  if (!port || *port < 1 || *port > 65535) fail("the port is no number from 1 to 65535");
  std::string host = target.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int failure = getaddrinfo(host.c_str(), nullptr, &hints, &found);
  if (failure != 0) fail(std::string("the host is not known: ") + gai_strerror(failure));
  freeaddrinfo(found);
  address_ = lo_address_new(host.c_str(), std::to_string(*port).c_str());
}

void OscTarget::send(lo_bundle bundle) const {
  lo_send_bundle(address_, bundle);
  lo_bundle_free_recursive(bundle);
}

}  // namespace depthmocap
