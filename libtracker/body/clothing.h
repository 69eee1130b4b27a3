#pragma once
#include <cstdint>

#include "libtracker/body/body_surface.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// What a body wears, as far as a depth camera sees it: how far cloth and hair stand off the skin. All 0: bare skin.
struct Clothing {
  double top_m = 0;            // [m] shirt or pullover off the trunk and the arms (0 .. 0.05)
  double sleeve = 0.3;         // [share of the arm] that sleeves cover (0 .. 1), 1 = to the wrist
  double trousers_m = 0;       // [m] trousers off the hips and legs (0 .. 0.05)
  double trouser_flare_m = 0;  // [m] added towards the hem (0 .. 0.06)
  double trouser_length = 1;   // [share of the leg] (0.2 .. 1), 1 = to the ankle
  double skirt_length = 0;     // [share of the leg] (0 .. 1); 0 = none
  double skirt_flare_m = 0;    // [m] wider at the hem than at the hips (0 .. 0.25)
  double hair_m = 0;           // [m] hair off the scalp (0 .. 0.06)
  double hair_length = 0;      // [0, 1] 0 = only on the scalp, 1 = down to the shoulder blades
  double shoes_m = 0;          // [m] shoes off the feet, and their soles (0 .. 0.04)
  double wrinkles = 0.35;      // [share of the distance] how uneven cloth and hair are (0 .. 0.8)
  std::uint64_t seed = 0;      // of the wrinkles
};

// Moves the surface outwards to the clothes. Vertices move, the rest (triangles, skin, parts, joints) stays, so the
// surface stays closed and cloth keeps the part of the limb under it; legs never cross the middle plane. A skirt is two
// halves that meet between the legs. Throws Error when a value is outside its range.
void dress(BodySurface& body, const Clothing& clothing);

// Everyday clothes: tight to wide tops and trousers, a few skirts, bald to long hair, bare feet to boots.
Clothing sampleClothing(Random& random);

}  // namespace depthmocap
