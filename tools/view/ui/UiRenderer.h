// SPDX-License-Identifier: Apache-2.0
/// UiRenderer: draws what Dear ImGui 1.86 describes, by this engine and through its public headers alone: a scene of
/// its own in a translucent view over the last image of a swap chain.
///   Colours  colours of ImGui are sRGB codes, which are not converted: opaque items have exactly those bytes
///            in any display target, and others are blended as codes, as by other renderers of ImGui. So
///            white text on black is the font atlas, byte by byte. Targets of light (RGBA16F) would take them for
///            light.
///   Clipping by the fragments: ui.mat drops those whose pixel lies outside of the rectangle, which every vertex
///            carries. This is what a scissor does, to the pixel and on both APIs; triangles cut on the CPU have new
///            corners, which rasterisers round, so that slanted edges move. It costs 8 bytes a vertex, and saves a draw
///            for each rectangle: neighbours with the same texture are one draw.
///   Update   geometry is uploaded only if it differs from that of the last frame.
///   Bits     the same on both APIs.
///   Thread   the app thread of the engine, which outlives the renderer.
///   Memory   buffers, lists and renderables grow to the largest interface so far; after that a frame allocates
///            nothing.
///   Cost     nothing without triangles; otherwise a view of the whole target with five passes.
///   Fails    create(): errors of the engine. A frame for which memory runs out is not drawn.
#pragma once

#include "tools/view/ui/UiGeometry.h"

#include <filament_core/Renderer.h>
#include <filament_core/Scene.h>

#include <imgui.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace filament_core::view {

/// For the statistics panel and for tests.
struct UiStatistics {
    uint32_t vertices = 0, indices = 0, draws = 0; ///< of the last frame
    uint32_t skippedTriangles = 0;                 ///< broken ones, and those whose texture is not known
    uint64_t uploads = 0, bufferGrowths = 0;       ///< since the beginning
};

class UiRenderer {
public:
    static Result<UiRenderer> create(Engine& engine);

    /// Uploads the atlas, building it if needed, and gives it its ImTextureID. Again after fonts change.
    void uploadFonts(ImFontAtlas& fonts);

    /// A texture for ImGui::Image(): 2D, of display values (RGBA8; RGBA8Srgb would be decoded to light and be too
    /// dark). It is kept until remove(). An identifier is never given twice, so one that is used for too long shows
    /// nothing.
    ImTextureID add(Texture texture, Sampler sampler = kUnfilteredSampler);
    void remove(ImTextureID id);

    /// Over the image that was rendered last. It must have as many pixels as the display has, by its scale: else the
    /// interface is not drawn.
    void render(ImDrawData const& drawData, SwapChain target, uint2 targetSize);

    UiStatistics const& statistics() const { return mStatistics; }

private:
    struct Slot {
        uint32_t generation = 0;
        Owned<MaterialInstance> instance{}; ///< none: free
    };
    /// What a renderable of the pool shows now.
    struct Shown {
        Renderable renderable{};
        UiRun run{};
        MaterialInstance material{};
        bool isVisible = false;
    };

    UiRenderer(Engine& engine, Owned<Material> material);
    bool upload();
    bool growBuffers();
    void show();
    void showRun(size_t place, UiRun const& run, MaterialInstance material);
    MaterialInstance materialOf(ImTextureID id) const;

    Engine* mEngine;
    Owned<Material> mMaterial;
    std::unique_ptr<Scene> mScene;
    std::unique_ptr<Renderer> mRenderer;
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
    size_t mVertexCapacity = 0, mIndexCapacity = 0;
    UiGeometry mGeometry, mUploaded; ///< of this frame, and of the buffers
    std::vector<Shown> mShown;
    std::vector<Slot> mSlots;
    Owned<Texture> mFonts;
    ImTextureID mFontsId{};
    UiStatistics mStatistics{};
};

} // namespace filament_core::view
