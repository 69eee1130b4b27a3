#include "libtracker/sensor/driver_table.h"

namespace depthmocap {

// Each in the driver's own source file.
CameraDriver openNiDriver();
CameraDriver v4l2Driver();
CameraDriver pipeDriver();
CameraDriver replayDriver();

// A new driver is its source file and a line here. The order is that of help texts and lists.
const DriverTable& cameraDrivers() {
  static const DriverTable kTable({
#ifdef DEPTHMOCAP_OPENNI2
      openNiDriver(),
#endif
      v4l2Driver(),
      pipeDriver(),
      replayDriver(),
  });
  return kTable;
}

}  // namespace depthmocap
