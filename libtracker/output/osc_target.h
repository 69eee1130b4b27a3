#pragma once
#include <string>

#include <lo/lo.h>

namespace depthmocap {

// A program that listens for OSC over UDP. That nobody listens is no failure.
class OscTarget {
 public:
  // `target` is HOST:PORT, given by `option`; Error where it is none or the host is unknown.
  OscTarget(const std::string& option, const std::string& target);
  ~OscTarget() { lo_address_free(address_); }
  OscTarget(const OscTarget&) = delete;
  OscTarget& operator=(const OscTarget&) = delete;

  // With immediate time tags; frees the bundle and its messages.
  void send(lo_bundle bundle) const;

 private:
  lo_address address_ = nullptr;
};

}  // namespace depthmocap
