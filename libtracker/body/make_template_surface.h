#pragma once
#include "depthmocap/body_shape.h"
#include "libtracker/actor/template_surface.h"

namespace depthmocap {

// About `points` points of the built-in man or woman of the template's stature, the same for the same arguments.
TemplateSurface makeTemplateSurface(Sex sex, int points);

// The bodies that come with the library, made anew.
ShippedBodies makeShippedBodies();

}  // namespace depthmocap
