"use strict";

// The colours of label pictures, and of what belongs to them in the scene. A label is a part plus PERSON_STEP for each
// person before its own (docs/reference/stream.md).
const PERSON_STEP = 16;

// [r, g, b] of each label. One person is shown by parts; several each in a colour of their own, whose light tells parts.
function labelColors(hello) {
  if (hello.people === 1) return hello.part_colors;
  const colors = [];
  for (const color of hello.person_colors) {
    for (let part = 0; part < PERSON_STEP; ++part) {
      const light = 1 - 0.16 * (part % 3);
      colors.push(color.map((v) => Math.round(v * light)));
    }
  }
  return colors;
}

function cssColor(color) {
  return `rgb(${color[0]}, ${color[1]}, ${color[2]})`;
}
