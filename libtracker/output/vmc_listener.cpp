#include "libtracker/output/vmc_listener.h"

#include <string>
#include <string_view>

#include <lo/lo.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

constexpr int kMostMessages = 32;

// liblo binds to every address, so what comes from elsewhere is told apart by its sender.
bool fromThisComputer(lo_message message) {
  const char* host = lo_address_get_hostname(lo_message_get_source(message));
  const std::string_view name = host == nullptr ? "" : host;
  return name == "localhost" || name == "::1" || name.substr(0, 4) == "127." || name.substr(0, 11) == "::ffff:127.";
}

int onCalibration(const char*, const char*, lo_arg**, int, lo_message message, void* asked) {
  if (fromThisComputer(message)) *static_cast<bool*>(asked) = true;
  return 0;
}

void ignoreError(int, const char*, const char*) {}

}  // namespace

struct VmcListener::Impl {
  explicit Impl(int port) : server(lo_server_new(port > 0 ? std::to_string(port).c_str() : nullptr, ignoreError)) {
    if (server == nullptr) {
      throw Error("the UDP port cannot be listened on", "--vmc-listen " + std::to_string(port), "choose another port");
    }
    for (const char* path : {"/VMC/Ext/Set/Calib/Ready", "/VMC/Ext/Set/Calib/Exec"}) {
      lo_server_add_method(server, path, nullptr, onCalibration, &asked);
    }
  }
  ~Impl() { lo_server_free(server); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool asked = false;
  lo_server server;
};

VmcListener::VmcListener(int port) : impl_(std::make_unique<Impl>(port)) {}

VmcListener::~VmcListener() = default;

bool VmcListener::calibrationAsked() {
  for (int i = 0; i < kMostMessages && lo_server_recv_noblock(impl_->server, 0) > 0; ++i) {
  }
  const bool asked = impl_->asked;
  impl_->asked = false;
  return asked;
}

int VmcListener::port() const {
  return lo_server_get_port(impl_->server);
}

}  // namespace depthmocap
