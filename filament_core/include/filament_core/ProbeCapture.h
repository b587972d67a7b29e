// SPDX-License-Identifier: Apache-2.0
/// captureProbe: what a reflection probe sees, drawn by the engine.
///   Out     a cube map as a KTX 2.0 file in memory: save it, let cmgen filter it into a package, or give it to
///           loadEnvironment(), which filters it now.
///   Thread  the app thread, which waits for the pixels of six frames. Not while a frame is drawn.
///   Memory  faceSize^2 * 48 B, and what a renderer of that size takes; all but the file is given back.
#pragma once

#include <filament_core/Renderer.h>

#include <cstddef>
#include <vector>

namespace filament_core {

struct ProbeCaptureOptions {
    uint32_t faceSize = 256; ///< pixels of a side, [16, 4096]
    /// Size, place, lens and viewport are replaced; everything else counts. The exposure should suit the place, because
    /// half floats end at 65504. Effects that look at neighbouring pixels leave seams.
    View view{};
};

struct ProbeCapture {
    std::vector<std::byte> ktx2; ///< half floats, one level, along the axes of the box
    float intensity = 1;         ///< for ReflectionProbeDesc::intensity: the nits of a texel of 1
};

/// From `place.captureInBoxMeters`. Other probes of the scene are reflected: captured once more, they see each other.
/// Fails as Renderer::waitPixels() and Engine::create() do.
Result<ProbeCapture> captureProbe(Engine& engine, Scene const& scene, ReflectionProbeDesc const& place,
                                  ProbeCaptureOptions const& options = {});

} // namespace filament_core
