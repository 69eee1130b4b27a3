#pragma once
#include <memory>
#include <string>
#include <vector>

namespace depthmocap {

// The OpenNI2 runtime of this process, with its drivers loaded; runs as long as somebody holds it.
class OpenNiRuntime {
 public:
  // Starts it unless it runs. Error if it finds no driver at all.
  static std::shared_ptr<OpenNiRuntime> start();
  OpenNiRuntime(const OpenNiRuntime&) = delete;
  OpenNiRuntime& operator=(const OpenNiRuntime&) = delete;
  ~OpenNiRuntime();

 private:
  OpenNiRuntime();
};

struct OpenNiDevice {
  std::string uri;
  std::string vendor;
  std::string name;
};

// The cameras that are plugged in now. Changes with the cable.
std::vector<OpenNiDevice> openNiDevices(const OpenNiRuntime& runtime);

// What the runtime says about its last failure, on one line.
std::string openNiError();

}  // namespace depthmocap
