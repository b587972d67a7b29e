// SPDX-License-Identifier: Apache-2.0
/// The shadow maps of a frame, as plain values: which maps there are, where they lie in the atlas, which of them are
/// drawn in this frame and which are kept from an earlier one.
///   Map     a square of texels of one depth texture, the atlas: what one light sees in one direction. A sun has a map
///           for each cascade, a spot one, a point up to six.
///   Depth   reversed, as everywhere: 1 at the light, 0 far away.
///   Moments for the filters vsm and evsm a second texture of the same size, with mip levels, that is made from the
///   depths.
#pragma once

#include "backend/api/Format.h"
#include "base/Arena.h"
#include "filament_core/prepare/ViewInput.h"
#include "filament_core/scene/Materials.h"
#include "shaders/interface/ShaderInterface.h"

#include <filament_core/Quality.h>

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::prepare {

/// Texels of a side; powers of two.
inline constexpr uint32_t kSmallestShadowMap = 32, kLargestShadowMap = 8192;

/// What filters read of a map, besides its depths: means of a distance and its square; or of two warped ones.
enum class ShadowMoments : uint8_t { None, Two, Four };

/// Mip levels of moments: the smallest of a map of kSmallestShadowMap has two texels a side.
inline constexpr uint8_t kShadowMomentLevels = 5;

constexpr backend::Format momentFormat(ShadowMoments moments) {
    return moments == ShadowMoments::Four ? backend::Format::RGBA32F : backend::Format::RG32F;
}

constexpr ShadowMoments momentsFor(ShadowFilter filter) {
    if (filter == ShadowFilter::Vsm) return ShadowMoments::Two;
    return filter == ShadowFilter::Evsm ? ShadowMoments::Four : ShadowMoments::None;
}

/// Whether shadows change what a material draws: if it is lit or catches shadows, and has been compiled with them.
inline bool canReceiveShadows(scene::Material const& material, ShadowFilter filter) {
    shader::MaterialPackage const& package = material.package;
    const int filtered = momentsFor(filter) == ShadowMoments::None
                                 ? shader::kVariantShadowReceiver
                                 : shader::kVariantShadowReceiver | shader::kVariantVsm;
    return filter != ShadowFilter::Off && (material.isLit() || package.shadowMultiplier) &&
           (package.filteredVariants & filtered) == 0;
}

/// A square of texels; aligned to its size.
struct ShadowTile {
    uint16_t x = 0, y = 0, size = 0;
    friend bool operator==(ShadowTile const&, ShadowTile const&) = default;
};

/// What the atlas holds in one tile.
struct HeldShadowMap {
    uint64_t owner = 0;    ///< the light and which of its maps
    uint64_t contents = 0; ///< hash of everything that was drawn into it
    ShadowTile tile;
};

/// What a renderer's atlas holds after the frame that was recorded last. Without texels: nothing.
struct ShadowAtlas {
    uint32_t size = 0; ///< texels of a side
    ShadowMoments moments = ShadowMoments::None;
    bool hasStencil = false;
    std::vector<HeldShadowMap> maps;
};

inline constexpr uint32_t kKeptMap = ~0u;

/// One map of a frame. Colour channels lie in the quarters of its tile, in the order of rows.
struct ShadowMapPacket {
    HeldShadowMap held;
    uint32_t channels = 1;    ///< 3: something in it transmits light, and each channel is drawn by itself
    uint32_t view = kKeptMap; ///< of FramePacket::views, which is drawn into the tile; kKeptMap: it is there already
};

/// The shadows of a frame. Without maps there are none, and no atlas.
struct ShadowPacket {
    uint32_t atlasSize = 0; ///< texels of a side
    ShadowMoments moments = ShadowMoments::None;
    bool hasStencil = false; ///< the maps of slabs are drawn with one: SlabCaps.h
    bool keepsAtlas = false; ///< the atlas of the frame before is used; false: nothing is in it yet
    std::span<const ShadowMapPacket> maps;
    shader::ShadowUniforms const* uniforms = nullptr; ///< as shaders read them, parallel to `maps`; null: no maps
    uint32_t drawn = 0;                               ///< maps with a view
};

constexpr ShadowTile channelTile(ShadowTile tile, uint32_t channels, uint32_t channel) {
    if (channels == 1) return tile;
    const auto half = static_cast<uint16_t>(tile.size / 2);
    return { static_cast<uint16_t>(tile.x + (channel & 1) * half),
             static_cast<uint16_t>(tile.y + (channel >> 1) * half), half };
}

inline ShadowTile channelTile(ShadowMapPacket const& map, uint32_t channel) {
    return channelTile(map.held.tile, map.channels, channel);
}

/// Channels of all maps that are drawn.
inline uint32_t drawnChannels(ShadowPacket const& shadows) {
    uint32_t count = 0;
    for (ShadowMapPacket const& map : shadows.maps) count += map.view == kKeptMap ? 0 : map.channels;
    return count;
}

} // namespace filament_core::prepare
