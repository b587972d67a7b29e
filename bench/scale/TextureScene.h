// SPDX-License-Identifier: Apache-2.0
/// TextureScene: a row of panels with a texture each, on a device, and what its frames take while a camera passes.
///   Files   one PNG of 2048 x 2048 texels under as many names as there are textures: 22.4 MB each with its levels, and
///           little to read. Each is decoded for itself.
///   View    320 x 180 pixels. The panels stand along a corridor of 2 m; the camera looks along it.
///   Times   of the app thread from the frame's begin until the device has drawn it, in milliseconds.
///   Memory  resident bytes of the process beyond those before its engine was made: all of the engine, the driver's
///           textures among it, and the encoded files.
///   Thread  one, with background threads that decode.   Fails: no device; a model that cannot be loaded.
#pragma once

#include <filament_core/filament_core.h>

#include <cstdint>
#include <vector>

namespace filament_core::bench {

struct TextureCase {
    uint32_t textures = 48;
    uint32_t budgetMegabytes = 0; ///< 0: whole textures
    Backend backend = Backend::Vulkan;
};

struct TextureFigures {
    double loadSeconds = 0;                 ///< until the model is there
    double firstFrameSeconds = 0;           ///< from the start of loading
    double settledSeconds = 0;              ///< from the start of loading until no texture is missing
    double peakBytes = 0;                   ///< while loading and settling
    double restBytes = 0;                   ///< after it
    std::vector<double> restMilliseconds;   ///< frames of a camera at rest
    std::vector<double> movingMilliseconds; ///< frames along the corridor
    double movingPeakBytes = 0;
    float movingErrorPixels = 0; ///< the largest of these frames
    TextureResidency residency;  ///< at rest
};

Result<TextureFigures> measureTextures(TextureCase const& size);

} // namespace filament_core::bench
