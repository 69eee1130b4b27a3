#include "apps/ik/request.h"
#include "apps/view/request_guard.h"
#include "apps/view/view_command.h"
#include "apps/view/web_server.h"
#include "tests/fuzz/connection.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

namespace {

// What `depthmocap serve` answers, without the page.
class Served {
 public:
  Served() : server_({.address = "127.0.0.1", .port = 0}) {
    server_.serveFile("/", {"text/html", "<p>page</p>"});
    server_.onPost("/ik", [this](const std::string& body) { return WebContent{"application/json", ik_.answer(body)}; });
    server_.onText([](const std::string& text) {
      each([&] { (void)parseViewCommand(text); });
      return text;
    });
    server_.start();
  }
  void give(std::string_view bytes) const { (void)askedOnce(server_.port(), bytes); }
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(server_.port()); }
  void ik(std::string_view body) const {
    each([&] { (void)ik_.answer(std::string(body)); });
  }

 private:
  IkRequests ik_{IkCommandOptions{}};
  WebServer server_;
};

}  // namespace

// First byte: 0 a connection's bytes as they are, 1 a WebSocket's after its handshake, 2 the body of POST /ik, else a
// message of the page.
static void give(std::string_view bytes) {
  static const Served served;
  if (bytes.empty()) return;
  const std::string rest(bytes.substr(1));
  if (bytes[0] == 0) served.give(rest);
  if (bytes[0] == 1) served.give(webSocketHandshake(served.host()) + rest);
  if (bytes[0] == 2) served.ik(rest);
  each([&] { (void)parseViewCommand(rest); });
  (void)queryValue(rest, "token");
  (void)refusal({.target = rest, .host = rest, .origin = rest, .authorization = rest}, {.token = "secret"});
}
DEPTHMOCAP_FUZZ(give)
