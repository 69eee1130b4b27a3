#include "apps/ik/routes.h"

namespace depthmocap {

void addIkRoutes(WebServer& server, const IkRequests& requests) {
  server.onPostAside("/ik", [&requests](const std::string& body) {
    return WebContent{"application/json", requests.answer(body)};
  });
  server.onGet("/openapi.json", [](const std::string&) {
    return WebContent{"application/json", std::string(embeddedOpenApi())};
  });
}

}  // namespace depthmocap
