// SPDX-License-Identifier: Apache-2.0
// Passes vectors and matrices to the library and back, by value and by reference, with whatever settings of GLM this
// file is compiled.
#include <filament_core/filament_core.h>

#include <cmath>
#include <cstdio>

namespace {

using namespace filament_core;

bool isNear(double a, double b) { return std::abs(a - b) < 1e-6; }

/// Looks from (1, 2, 3) down -Z: columns of the rotation are the axes, the last one is the eye.
bool isCameraRight() {
    const Camera camera =
            Camera::lookAt(double3(1, 2, 3), double3(1, 2, 0), { .verticalFovDegrees = 90, .nearMeters = 0.5f });
    const double expected[4][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 1, 2, 3, 1 } };
    bool right = camera.lens.nearMeters == 0.5f && camera.lens.verticalFovDegrees == 90;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) right &= isNear(camera.worldFromView[column][row], expected[column][row]);
    }
    // a field of view of 90 degrees: y is scaled by 1, x by the aspect ratio's inverse; depth is near / distance
    const float4x4 clipFromView = camera.clipFromView(2.0f);
    right &= isNear(std::abs(clipFromView[1][1]), 1) && isNear(clipFromView[0][0], 0.5);
    const float4 clip = clipFromView * float4(0, 0, -2, 1);
    return right && isNear(clip.z / clip.w, 0.25);
}

} // namespace

int main() {
    const bool right = isCameraRight();
    std::printf("glm_settings: sizes %zu %zu %zu, camera %s\n", sizeof(float3), sizeof(double3), sizeof(Camera),
                right ? "right" : "WRONG");
    return right ? 0 : 1;
}
