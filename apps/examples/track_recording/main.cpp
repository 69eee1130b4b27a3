// Prints the joints file of a recording, as `depthmocap replay REC --joints FILE` writes it.
#include <iostream>

#include <depthmocap/depthmocap.h>

int main(int argc, char** argv) try {
  if (argc != 2) throw depthmocap::Error("takes one recording", "track_recording");
  depthmocap::Session session(depthmocap::Recording{argv[1]});
  depthmocap::JointsCsv joints(std::cout);
  session.run([&](const depthmocap::TrackedFrame& frame) { joints.write(frame); });
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
