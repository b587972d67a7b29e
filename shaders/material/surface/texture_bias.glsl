// SPDX-License-Identifier: Apache-2.0
// The mip levels that a view adds to those of materials' textures. Nothing here is called by name: the compiler puts the
// calls where an author's code looks textures up (shaders/compiler/BiasTextures.h). The engine's own look-ups name their
// levels.

layout(constant_id = 1021) const int quality_mipBias = 0; // kQualityMipBias

bvec4 mipBias_isBiased() { return bvec4(quality_mipBias != 0); }
float mipBias_levels() { return passUniforms.raster.w; }
float mipBias_factor() { return exp2(passUniforms.raster.w); }

// Unused functions do not reach the pass that needs them. This call is unused, so it is removed after that pass.
float mipBias_unread = mipBias_isBiased().x ? mipBias_levels() : mipBias_factor();
