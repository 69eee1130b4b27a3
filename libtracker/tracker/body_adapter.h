#pragma once
#include "depthmocap/actor.h"
#include "libtracker/shape/shape_fit.h"

namespace depthmocap {

// Fits the body of an uncalibrated actor while tracking, and fixes it afterwards: the stature by a running mean over
// the first seconds that show all of the actor, the shape by the depth of some more.
class BodyAdapter {
 public:
  // `size_s`, `shape_s` [s]: of frames that each is fitted over; a calibrated actor is never adapted.
  BodyAdapter(const Actor& actor, bool calibrated, double size_s, double shape_s);

  [[nodiscard]] const Actor& actor() const { return actor_; }
  [[nodiscard]] bool fitsSize() const { return size_left_s_ > 0; }
  [[nodiscard]] bool fitsShape() const { return shape_left_s_ > 0; }
  // Its shape was fitted to so many frames that it is better than an average one.
  [[nodiscard]] bool isFitted() const;
  // The same body, no longer adapted.
  [[nodiscard]] BodyAdapter fixed() const;
  // Of the actor's surface, while it is being fitted.
  [[nodiscard]] const ShapeVector& shape() const { return shape_; }

  // The present size times `scale`, at once: for the first pose.
  void rescale(double scale);
  // `scale`: how much larger than the present body one frame shows it; `dt_s`: time that the frame stands for, 0 for
  // one that shows too little to settle the size.
  void observeSize(double scale, double dt_s);
  // `dt_s`: time that the frame stands for.
  void observeShape(const ShapeEvidence& frame, double dt_s);

 private:
  void wear(const ShapeVector& shape);

  Actor actor_;
  double stature_m_;  // as seen, whatever the shape adds up to
  ShapeVector shape_;
  ShapeFit fit_;
  double size_left_s_, shape_left_s_;
  int sizes_ = 0;  // observed
};

}  // namespace depthmocap
