#pragma once
#include <memory>

namespace depthmocap {

// Listens for what VMC assistants send (OSC over UDP): /VMC/Ext/Set/Calib/Ready and /VMC/Ext/Set/Calib/Exec ask for a
// calibration. Everything else, and what comes from other computers, is passed over.
class VmcListener {
 public:
  // Error where the port is taken. `port` 0: any that is free.
  explicit VmcListener(int port);
  ~VmcListener();
  // Looks at what has come, at most 32 messages; true if a calibration was asked for since the last call.
  bool calibrationAsked();
  [[nodiscard]] int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
