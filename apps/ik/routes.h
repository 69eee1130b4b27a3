#pragma once
#include <string_view>

#include "apps/ik/request.h"
#include "apps/view/web_server.h"

namespace depthmocap {

// POST /ik and GET /openapi.json, before the server starts. `requests` must outlive it.
void addIkRoutes(WebServer& server, const IkRequests& requests);

// docs/reference/openapi.json: describes every endpoint of `serve`.
std::string_view embeddedOpenApi();

}  // namespace depthmocap
