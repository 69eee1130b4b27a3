#pragma once
#include <optional>

#include "forest/render/depth_renderer.h"
#include "forest/render/named_camera.h"
#include "forest/render/smooth_noise.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// How holes of a stereo image are filled: not, from the left, from the farther side, or with a ramp between both sides
// (librealsense's post-processing has the first three; aligning and resampling programs make ramps).
enum class HoleFilling { None, FromLeft, Farthest, Ramp };

// Active infrared stereo as of the RealSense D400 series and Orbbec's stereo cameras. Pixels are those of a 640 px wide
// image of f = 617 px; other images scale them. Facts: Keselman et al. 2017 (Intel RealSense stereoscopic depth
// cameras: noise grows with the square of the distance, subpixel error 0.05 to 0.1 px); Grunnet-Jepsen et al., tuning
// white papers of the D400 series (holes where the second imager does not see, post-processing filters); Halmetschlager
// et al. 2019 (ten depth sensors compared). Spreads of the filters were chosen by eye beside real pictures.
struct StereoNoise {
  double baseline_m = 0.050;        // [m] second imager to the right of the first
  double disparity_noise_px = 0.1;  // [px] standard deviation, correlated over a matching window
  double window_px = 9.0;           // [px] correlation length of that noise: walls look wavy
  double fattening_px = 3.0;        // [px] how far silhouettes may grow over what is behind
  double dropout = 0.1;             // [0, 1] share of the surface without texture that gives no match at 2 m
  double dropout_px = 28.0;         // [px] size of such patches
  double grazing_cos = 0.1;         // surfaces seen flatter than this give no match
  HoleFilling filling = HoleFilling::Ramp;
  double smoothing_px = 6.0;   // [px] reach of the spatial filter across edges; 0 = no filter
  double min_depth_m = 0.25;   // [m]
  double max_depth_m = 10.0;   // [m]
  double dropout_power = 1.0;  // how that share grows with the distance: 2 as the light of the projector fades
  double edge_gap_px = 0.0;    // [px] within this of a depth edge windows find no match
  double fill_px = 1e9;        // [px] wider holes stay
  bool blind_band = false;     // the image's left border, which the second imager does not see, gives no match
};

// The settings of a named camera; nothing for cameras that are no stereo cameras.
std::optional<StereoNoise> stereoNoiseOf(SensorKind kind);

// Turns a noise-free picture into what a stereo camera delivers. Keeps its working memory: use one object per thread.
class StereoSensor {
 public:
  StereoNoise noise;

  // What render() must compute for apply().
  [[nodiscard]] RenderOptions renderOptions() const;
  // depth [m], 0 = no measurement; `parts` is the part of the surface that is nearest to what each pixel says. `view`
  // rendered with renderOptions(). Equal random states, equal results.
  void apply(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth, PartImage& parts);

 private:
  void match(const RenderedView& view, double scale, Random& random, DepthImage& depth, PartImage& parts);
  void fillHoles(double fill_px, DepthImage& depth, PartImage& parts) const;
  void smooth(double reach_px, DepthImage& depth, PartImage& parts);

  SmoothNoise error_, texture_, growth_;
  DepthImage before_;
};

}  // namespace depthmocap
