#pragma once
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <string>
#include <string_view>

#include "apps/view/web_server.h"

namespace depthmocap {

using WebRequest = boost::beast::http::request<boost::beast::http::string_body>;
using WebRequestHeader = boost::beast::http::request_header<>;
using WebResponse = boost::beast::http::response<boost::beast::http::string_body>;

inline std::string_view plainView(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

// HEAD is GET without the body.
inline boost::beast::http::verb methodOf(const WebRequestHeader& header) {
  using boost::beast::http::verb;
  return header.method() == verb::head ? verb::get : header.method();
}

// {"error": text}
WebContent errorContent(int status, const std::string& text);

// What every answer says about itself to browsers: no other page may hold it, nothing from elsewhere is loaded.
void setCommonFields(boost::beast::http::fields& fields, const std::string& type);

// The answer to a request of this header (a request is one): HEAD gets no body.
template <typename Header>
WebResponse responseOf(WebContent content, const Header& request) {
  namespace http = boost::beast::http;
  WebResponse response{static_cast<http::status>(content.status), request.version()};
  setCommonFields(response, content.type);
  response.keep_alive(request.keep_alive() && content.status < 400);
  response.body() = std::move(content.body);
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();  // its length stays in the header
  return response;
}

}  // namespace depthmocap
