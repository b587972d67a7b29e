// SPDX-License-Identifier: Apache-2.0
// Numbers of DebugView that surfaces and the pass which shows them both need.

const int kViewBaseColor = 16;
const int kViewRoughness = 17;
const int kViewMetallic = 18;
const int kViewNormals = 19;
const int kViewTangents = 20;
const int kViewTextureCoordinates = 21;
const int kViewMaterialOcclusion = 22;
const int kViewEmissive = 23;
const int kViewMipLevel = 24;
const int kViewOverdraw = 25;
const int kViewTransparentLayers = 26;
const int kViewPlausibility = 29;
const int kViewGeometricNormals = 31;
const int kViewPositions = 33;
const int kViewObjectIds = 34;
const int kViewMaterialIds = 35;
const int kViewMaterialInstanceIds = 36;
const int kViewTriangleIds = 37;
const int kViewCoverage = 38;

// Numbers of triangles are in two parts, which half floats hold: debug_edges.mat.
const int kTriangleStep = 2048;

// Not a DebugView: the depth of caps alone, as depth buffers have it (passes/SectionDepthPass.h).
const int kViewCapDepth = 63;

// Added to the view of surfaces whose numbers are wanted, in full floats, not their colours.
const int kViewNumbers = 64;

// Alpha of the output: for a value; for a material without such an input. Without a surface: 0.
const float kHasValue = 1.0;
const float kHasNone = 0.5;
