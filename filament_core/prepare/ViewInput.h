// SPDX-License-Identifier: Apache-2.0
/// ViewInput: from where a scene is looked at, and what for. What preparing a view reads besides the scene.
///   In      plain values; an engine's View, or what a shadow map or a probe needs.
///   Thread  any.   Memory: none.   Fails: never.
#pragma once

#include <filament_core/Camera.h>
#include <filament_core/View.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace filament_core::prepare {

/// What a view is drawn for. Depth, Shadow and Motion draw opaque and masked objects, without lights: positions, bones
/// and morph targets are all that such draws read, and masked materials their fragment stage.
enum class ViewKind : uint8_t {
    Color,  ///< light: what a camera sees
    Depth,  ///< depth alone, of what a camera sees
    Shadow, ///< depth alone, of what a light reaches
    Motion, ///< where the last frame showed what moved
};
inline constexpr size_t kViewKinds = 4;
constexpr bool isShaded(ViewKind kind) { return kind == ViewKind::Color; }

/// View::display, as shaders/lib/tone.glsl reads it (values/ToneShader.h).
struct DisplaySettings {
    int32_t toneMapper = 0, outputSpace = 0;
    float4 toneCurve{ 0 };
    float whiteShare = 0;
    float halfWhiteLight = 0.5f; ///< which the tone mapper displays at half of white
    bool hasNumbers = false;     ///< the curve or the output space reads some of the above
    bool dithers = false;
};

/// `quality` to `debugView`: of the main view; FrameSettings resolves them.
struct ViewInput {
    ViewKind kind = ViewKind::Color;
    Camera camera{};
    /// Takes the place of the camera's lens, as parallel light or a tile of an atlas needs it. The conventions of
    /// Camera::clipFromView(): row 0 of the image at y = -1, reversed depth.
    std::optional<float4x4> clipFromView{};
    /// From the camera along its axis: whatever is farther is left out; 0: nothing is. For lamps, whose near plane
    /// leaves nothing out.
    float farMeters = 0;
    uint2 size{ 1, 1 };              ///< pixels that are drawn, >= 1
    uint2 shownSize{ 0, 0 };         ///< of the image that is made of them; 0: the same
    uint32_t band = 0;               ///< of `size`, on each side, that the image does not show
    float2 jitterPixels{ 0 };        ///< the image moves by so much, to the right and down
    uint8_t samples = 1;             ///< a pixel
    uint32_t maxTextureSize = 16384; ///< texels a side that the device allows
    bool occlusionCulling = true;
    float lodPixels = 0; ///< View::lod, of the image that is made; [0, 64]
    double timeSeconds = 0;
    std::array<float4, 4> materialGlobals{}; ///< View::materialGlobals
    SectionPlanes section{};                 ///< View::section
    Quality quality{};
    Effects effects{}; ///< within their ranges
    DisplaySettings display{};
    float4 clearColor{ 0, 0, 0, 1 };
    std::optional<Viewport> viewport{};
    DebugView debugView = DebugView::None;
    bool givesNumbers = false;         ///< of debugView, instead of its colours: View::aov
    Layers visibleLayers = kAllLayers; ///< of renderables
    /// Not 0: that light of the scene, by its record, is as any other, but dark (DarkLights.h). None: all shine.
    std::span<const uint8_t> darkLights{};
    bool darkEnvironment = false; ///< the light of the environment, probes and grids is 0; the sky stays
    uint64_t contents = 0;        ///< another number whenever the app changed the scene or a material

    uint2 inside() const { return size - 2u * band; } ///< pixels of the image that are drawn
    uint2 shown() const { return shownSize.x > 0 ? shownSize : inside(); }
};

} // namespace filament_core::prepare
