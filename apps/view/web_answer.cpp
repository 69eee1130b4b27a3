#include "apps/view/web_answer.h"

#include <boost/beast/http/field.hpp>
#include <nlohmann/json.hpp>

namespace depthmocap {

namespace http = boost::beast::http;

WebContent errorContent(int status, const std::string& text) {
  const auto replace = nlohmann::json::error_handler_t::replace;
  return {"application/json", nlohmann::json{{"error", text}}.dump(-1, ' ', false, replace), status};
}

void setCommonFields(http::fields& fields, const std::string& type) {
  fields.set(http::field::content_type, type);
  fields.set(http::field::cache_control, "no-store");
  fields.set("X-Content-Type-Options", "nosniff");
  fields.set("Referrer-Policy", "no-referrer");
  fields.set("Content-Security-Policy",
             "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws: wss:; frame-ancestors 'none'");
}

}  // namespace depthmocap
