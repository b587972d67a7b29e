// SPDX-License-Identifier: Apache-2.0
// Section planes (View::section), before the material's own code: which point of the view ray a fragment shows.
//
// The first surface behind a plane along a view ray is a back face where the ray enters what is left inside of a solid.
// So the fragments of back faces whose ray has crossed a plane show a cap: the point where the ray enters, with the
// plane's normal. They keep the depth of the back face: were it that of the cap, back faces of solids that the ray
// enters later, from outside, would hide their own front.

highp vec3 section_point; // what the fragment shows, relative to the camera
bool section_isCap = false;

bool isSectionCap() { return section_isCap; }

highp vec3 pointOfMesh() { return vertex_worldPosition; }

#define vertex_worldPosition section_point
