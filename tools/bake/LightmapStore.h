// SPDX-License-Identifier: Apache-2.0
/// storeLightmap: the pages of a lightmap as KTX 2.0 files, and how far what they hold is off.
///   Half     RGBA16F, 8 bytes a texel: ten bits of each channel.
///   Rgb9e5   RGB9E5 and an openness of 8 bits, 5 bytes a texel: nine bits of the largest channel. It takes the place
///            of RGBM, which has as many bytes, eight bits and a range that must be chosen.
///   Bc6h     BC6H and an openness of BC4, 1.5 bytes a texel (Bc6Encoder.h).
///   Openness without it, alpha is 1, and the engine can keep BC6H compressed.
///   Out      what the engine reads of them, decoded by its own decoder; the error beside the image in lux.
///   Thread   any; works on the job system. The same bytes for any number of workers.
#pragma once

#include "base/Result.h"
#include "jobsystem/JobSystem.h"
#include "tools/bake/LightmapImage.h"

#include <string_view>

namespace filament_core::bake {

enum class LightmapFormat : uint8_t { Half, Rgb9e5, Bc6h };
inline constexpr std::array<std::string_view, 3> kLightmapFormatNames{ "half", "rgb9e5", "bc6h" };

struct StorageChoice {
    LightmapFormat format = LightmapFormat::Half;
    bool hasOpenness = true;
};

/// Of the first level, over the texels of charts that see light.
struct StorageError {
    double rmsLux = 0, worstLux = 0; ///< of the luminance
    double meanRelative = 0;         ///< root mean square of each texel's error over its own luminance
    double opennessRms = 0;          ///< [0, 1]
};

struct StoredLightmap {
    std::vector<std::vector<std::byte>> pages;    ///< KTX 2.0
    std::vector<std::vector<std::byte>> openness; ///< as many, or none: it is in the alpha of the pages, or left out
    assets::Image read;                           ///< RGBA16F, all pages below each other, first level
    StorageError error{};
    uint64_t bytes = 0; ///< of all files
};

StoredLightmap storeLightmap(LightmapImage const& image, std::span<const AtlasTexel> texels,
                             std::span<const TexelLight> lights, StorageChoice const& choice, jobs::JobSystem& jobs);

} // namespace filament_core::bake
