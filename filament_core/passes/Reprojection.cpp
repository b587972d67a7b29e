// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/Reprojection.h"

#include "base/Assert.h"

namespace filament_core::passes {
namespace {

/// `end`: of the image in the texture.
double4x4 textureFromClip(double2 end) {
    double4x4 texture(1.0);
    texture[0][0] = texture[3][0] = end.x / 2;
    texture[1][1] = texture[3][1] = end.y / 2;
    return texture;
}

} // namespace

double4x4 worldFromPixel(FrameContext const& context) {
    const double2 size(context.settings().size);
    double4x4 clipFromPixel(1.0);
    clipFromPixel[0][0] = 2 / size.x, clipFromPixel[1][1] = 2 / size.y;
    clipFromPixel[3] = double4(-1, -1, 0, 1);
    // Products of a matrix and the inverse of another nearly cancel: in floats, a still camera would move pixels.
    return double4x4(context.packet.mainView().uniforms.worldFromClip) * clipFromPixel;
}

float4x4 lastFromPixel(FrameContext const& context, double2 end) {
    return float4x4(textureFromClip(end) * double4x4(context.packet.last.clipFromWorld) * worldFromPixel(context));
}

bool isParallel(float4x4 const& clip) { return clip[3].w != 0; }

float2 distanceOfDepth(float4x4 const& clip) {
    FILAMENT_ASSERT(isParallel(clip) && clip[2].z != 0, "a parallel projection has a near and a far plane");
    return { -1 / clip[2].z, clip[3].z / clip[2].z }; // depth = m22 z + m32
}

float2 inverseOfDepth(float4x4 const& clip) {
    FILAMENT_ASSERT(!isParallel(clip), "the inverse distance is linear in the depth of perspective projections only");
    return { 1 / clip[3].z, clip[2].z / clip[3].z }; // depth = (m22 z + m32) / -z
}

} // namespace filament_core::passes
