// Prints a joints file of some seconds of a camera: track_camera v4l2:/dev/video0 10 (or replay:REC for the camera)
#include <iostream>

#include <depthmocap/depthmocap.h>

int main(int argc, char** argv) try {
  if (argc != 3) throw depthmocap::Error("takes a camera and seconds", "track_camera");
  depthmocap::Session session(depthmocap::Camera{argv[1]}, {.seconds = std::stod(argv[2])});
  depthmocap::JointsCsv joints(std::cout);
  session.run([&](const depthmocap::TrackedFrame& frame) { joints.write(frame); });
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
