#pragma once
#include <memory>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/core/config_fields.h"

namespace depthmocap {

// How a classifier looks at an image.
struct ClassifyConfig {
  int stride = 2;    // [px] (>= 1) classify every stride-th pixel in x and y
  int threads = 1;   // (>= 1)
  bool simd = true;  // use the processor's vector instructions where it has them; the result is the same
  // (>= 0, not all 0) what is known of the side that is seen before the image is looked at, at any scale
  FacingShares facing_prior = {1, 1, 1, 1};

  std::vector<ConfigField> fields();  // those that a user may choose
  void validate() const;
};

// Stage (1): which body part does each pixel of the actor belong to? The tracker knows this interface only;
// ForestClassifier is the one that comes with it. A classifier is constant and may be shared by threads; what changes
// from image to image lies in a Memory, one per caller.
class PartClassifier {
 public:
  // What classify() remembers of its last image, for reuse and for assumeFacing().
  class Memory {
   public:
    Memory() = default;
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    virtual ~Memory() = default;
  };

  PartClassifier() = default;
  PartClassifier(const PartClassifier&) = delete;
  PartClassifier& operator=(const PartClassifier&) = delete;
  virtual ~PartClassifier() = default;

  [[nodiscard]] virtual std::unique_ptr<Memory> newMemory() const = 0;
  // Whether the classifier can tell from which side the actor is seen. If not, all facings stay equally likely and
  // assumeFacing() is never called.
  [[nodiscard]] virtual bool tellsFacings() const = 0;

  // The distribution over the parts of each pixel of the actor (mask != 0, with a measurement). `depth` [m] and `mask`
  // have the camera's size; `memory` is one of newMemory(). The same result for any number of threads. No allocation
  // once `memory` and `result` have seen the largest actor.
  virtual void classify(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera,
                        const ClassifyConfig& config, Memory& memory, ClassifiedPixels& result) const = 0;
  // The distributions again, as if the facings had these probabilities (>= 0, not all 0); `memory` as the last
  // classify() left it, `pixels` its result or a copy.
  virtual void assumeFacing(const FacingShares& facing, int threads, const Memory& memory,
                            ClassifiedPixels& pixels) const = 0;
};

}  // namespace depthmocap
