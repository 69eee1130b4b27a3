#include "libtracker/choreography/body_frame.h"

namespace depthmocap {
namespace {

// The one list of channels: calls visit(number) for each, in order.
template <typename Frame, typename Visit>
void visitChannels(Frame& frame, Visit&& visit) {
  auto& p = frame.pelvis;
  for (auto* value : {&p.x, &p.z, &p.y, &p.heading, &p.lean, &p.tilt, &p.held}) visit(*value);
  for (auto* value : {&frame.spine.bend, &frame.spine.twist, &frame.spine.side}) visit(*value);
  for (auto* value : {&frame.head.nod, &frame.head.side, &frame.head.turn}) visit(*value);
  for (auto* arm : {&frame.left_arm, &frame.right_arm}) {
    for (auto* value : {&arm->clavicle_y, &arm->clavicle_z, &arm->twist, &arm->swing_y, &arm->swing_z, &arm->elbow}) {
      visit(*value);
    }
  }
  for (auto* foot : {&frame.left_foot, &frame.right_foot}) {
    for (auto* value : {&foot->x, &foot->z, &foot->ground, &foot->lift, &foot->pitch, &foot->heading, &foot->heel_rise,
                        &foot->knee_out}) {
      visit(*value);
    }
  }
}

}  // namespace

FrameChannels channelsOf(const BodyFrame& frame) {
  FrameChannels channels;
  int i = 0;
  visitChannels(frame, [&](double value) { channels[i++] = value; });
  return channels;
}

BodyFrame frameOf(const FrameChannels& channels) {
  BodyFrame frame;
  int i = 0;
  visitChannels(frame, [&](double& value) { value = channels[i++]; });
  return frame;
}

}  // namespace depthmocap
