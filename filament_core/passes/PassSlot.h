// SPDX-License-Identifier: Apache-2.0
/// PassSlot: where pipelines draw, and what one is chosen by besides.
///   Thread  any; plain values.   Memory: none.   Fails: never.
#pragma once

#include "backend/api/Descriptions.h"
#include "filament_core/passes/ShadingKey.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/scene/SceneData.h"

#include <cstdint>
#include <optional>

namespace filament_core::passes {

/// What surfaces leave instead of light, for debug views: with the tests, writes and faces of their materials, but not
/// blended.
enum class DebugSlot : uint8_t {
    None,
    Values, ///< what their variants with kVariantDebug give
    Counts, ///< counts of surfaces, added up
    Edges,  ///< the numbers of their triangles: FrameResources::edges has the fragment stage. Everything hides what is
            ///< behind
    Triangles, ///< these numbers, of what has left the depth that is there, so that masks have their holes
    Coverage,  ///< how much of the background they cover: transparent ones are blended by their alpha
};

/// Where a pipeline draws, and how lit materials are shaded there.
struct PassSlot {
    backend::PassLayout layout{};
    uint8_t subpass = 0;
    ShadingKey shading = 0;
    DepthRange depthRange = DepthRange::Reversed;
    ShadingPrecision precision = ShadingPrecision::Full;
    bool isFullScreen = false; ///< no geometry of the scene is drawn there
    bool depthOnly = false;    ///< surfaces are drawn by their variants with kVariantDepth
    bool motionOnly = false;   ///< surfaces are drawn by their variants with kVariantMotion, where their depth is known
    bool isShadowMap = false;  ///< those of them that cast, with the faces that do
    shader::TransparencyTerm transparency = shader::kTransparencyInOrder; ///< all that is drawn blends in any order
    DebugSlot debug = DebugSlot::None;
    scene::Material const* edges = nullptr; ///< of DebugSlot::Edges and Triangles
    bool equalsDepth = false;               ///< surfaces are drawn where the prepass left their depth, and nowhere else
    bool cutsSections = false;              ///< materials with section planes show both sides: caps are on back faces
    bool isPick = false;                    ///< of depthOnly: whatever their material says, they test and leave depth
    std::optional<StencilState> stencil{};  ///< of what is drawn there, without references: SlabCaps.h, PipelineCache
    friend bool operator==(PassSlot const&, PassSlot const&) = default;
};

/// What a pipeline is chosen by, besides where it draws.
struct PipelineUse {
    scene::MaterialInstance const& instance;
    uint32_t geometryLayout = 0; ///< into GeometryLayouts
    uint8_t variant = 0;         ///< VariantBits that the scene selects
    bool mirrored = false;
    prepare::DrawPass pass = prepare::DrawPass::Only;
};

} // namespace filament_core::passes
