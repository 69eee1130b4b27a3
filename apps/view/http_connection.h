#pragma once
#include <boost/asio/ip/tcp.hpp>
#include <memory>

#include "apps/view/web_server_impl.h"

namespace depthmocap {

// Answers the requests of one connection until it ends or becomes a stream. `server` outlives it.
void startHttpConnection(boost::asio::ip::tcp::socket socket, WebServer::Impl& server);

}  // namespace depthmocap
