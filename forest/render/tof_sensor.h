#pragma once
#include "forest/render/depth_renderer.h"
#include "forest/render/smooth_noise.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// Time of flight as of the Azure Kinect (narrow field of view, unbinned). Facts and sources:
// docs/design/rendered-cameras.md.
struct TofNoise {
  double noise_m = 0.0012;          // [m] standard deviation close by
  double noise_per_m2 = 0.0004;     // [1/m] more of it per squared metre of distance
  double edge_dropout = 0.55;       // [0, 1] share of the silhouette pixels that the camera takes for ambiguous
  double flying_share = 0.35;       // [0, 1] share of the others that mix two depths
  double grazing_cos = 0.07;        // surfaces seen flatter than this return too little light
  double multipath_reach_m = 0.30;  // [m] from a concave corner, so far light comes by the other wall
  double multipath = 0.12;          // of what the corner recedes within that reach: how much farther walls seem
  double wiggle_m = 0.003;          // [m] slowly varying error, standard deviation
  double wiggle_px = 80.0;          // [px] its correlation length
  double min_depth_m = 0.5;         // [m] specified 0.5 .. 3.86 m;
  double max_depth_m = 3.86;        // [m]
  double fade_m = 1.6;              // [m] bright surfaces are measured farther, fewer with the distance
};

// Whether the illumination of the Azure Kinect reaches a pixel of its image: a hexagon, wide at half height.
bool insideHexagon(int x, int y, int width, int height);

// Turns a noise-free picture into what the camera delivers. Keeps its working memory: use one object per thread.
class TofSensor {
 public:
  TofNoise noise;

  [[nodiscard]] RenderOptions renderOptions() const;
  // depth [m] in whole millimetres, 0 = no measurement; parts as SensorModel::apply. `view` rendered with
  // renderOptions(). Equal random states, equal results.
  void apply(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth, PartImage& parts);

 private:
  SmoothNoise wiggle_, reflectance_;
};

}  // namespace depthmocap
