// SPDX-License-Identifier: Apache-2.0
/// View: a camera and the settings of its image. A plain value; its options by name: setOption() (Options.h).
#pragma once

#include <filament_core/Aov.h>
#include <filament_core/Camera.h>
#include <filament_core/DisplayTransform.h>
#include <filament_core/Effects.h>
#include <filament_core/Objects.h>
#include <filament_core/Options.h>
#include <filament_core/PostProcess.h>
#include <filament_core/Quality.h>
#include <filament_core/SectionPlanes.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace filament_core {

class DebugDraw;

/// Decisions of the engine per pixel, properties of materials, or the numbers in the scene colour, instead of the
/// image: for tools and tests. docs/debug-views.md explains the colours and links to the other pages;
/// <filament_core/DebugViews.h> has them as values. Such a frame has one sample a pixel and no tone mapper.
enum class DebugView : uint8_t {
    None,
    Cascades,          ///< the image in grey, tinted by the cascade of the sun that shades each pixel
    Atlas,             ///< the atlas of shadow maps: depths, and the outlines of its tiles
    Froxels,           ///< how many lights the list of each pixel's froxel has
    Lights,            ///< how many lights of the list reach each pixel: those whose range and cone contain it
    Occlusion,         ///< the visibility that ambient occlusion computes
    BentNormals,       ///< the mean unoccluded direction, in world space
    Reflections,       ///< length of reflected rays until their hit on screen
    Refraction,        ///< the blurred level of the scene colour in each refractive pixel
    Fog,               ///< opacity of fog in each pixel
    Motion,            ///< motion vectors: from the previous frame to this one
    CircleOfConfusion, ///< blur radius of depth of field, in front of and behind the focus
    HistoryWeight,     ///< weight of the TAA history in each pixel
    Histogram,         ///< the histogram of auto exposure, and the resulting exposure
    // Numbers in the scene colour:
    Luminance, ///< stops above or below middle grey
    Numerics,  ///< NaN, infinities, values out of range or coarse in half floats, and clipped ones
    // Results of the code of materials, of the visible surface:
    BaseColor,
    Roughness, ///< perceptual
    Metallic,
    Normals,            ///< of shading, in world space
    Tangents,           ///< in world space
    TextureCoordinates, ///< the first ones
    MaterialOcclusion,  ///< of the material; Occlusion is in screen space
    Emissive,           ///< pre-exposed
    MipLevel,           ///< at which a texture of 1024 texels a side would be read by the first coordinates
    // Cost of drawing:
    Overdraw,          ///< how many fragments are shaded in each pixel
    TransparentLayers, ///< visible transparent surfaces in each pixel
    Wireframe,         ///< the edges of visible triangles, over the image
    WireframeAlone,    ///< without the image
    // Another result of the code of materials:
    Plausibility, ///< values that no real material has, by the rule that they break
    // Another decision of the engine:
    Probes, ///< the image in grey, tinted by the reflection probes that light each pixel
    // The geometry of the visible surface:
    GeometricNormals, ///< in world space, without normal maps
    Depth,            ///< of opaque surfaces, along the view
    Positions,        ///< of opaque surfaces in the world, repeated each metre
    // What the visible surface belongs to, a colour for each number (docs/aovs.md):
    ObjectIds,           ///< the renderable
    MaterialIds,         ///< the material that it is drawn with
    MaterialInstanceIds, ///< the instance of that material
    TriangleIds,         ///< the triangle of the mesh
    Coverage,            ///< share of each pixel that surfaces cover, of View::samples
};
template <>
struct EnumNames<DebugView> {
    static constexpr std::array<std::string_view, 39> values{ "none",
                                                              "cascades",
                                                              "atlas",
                                                              "froxels",
                                                              "lights",
                                                              "occlusion",
                                                              "bentNormals",
                                                              "reflections",
                                                              "refraction",
                                                              "fog",
                                                              "motion",
                                                              "circleOfConfusion",
                                                              "historyWeight",
                                                              "histogram",
                                                              "luminance",
                                                              "numerics",
                                                              "baseColor",
                                                              "roughness",
                                                              "metallic",
                                                              "normals",
                                                              "tangents",
                                                              "textureCoordinates",
                                                              "materialOcclusion",
                                                              "emissive",
                                                              "mipLevel",
                                                              "overdraw",
                                                              "transparentLayers",
                                                              "wireframe",
                                                              "wireframeAlone",
                                                              "plausibility",
                                                              "probes",
                                                              "geometricNormals",
                                                              "depth",
                                                              "positions",
                                                              "objectIds",
                                                              "materialIds",
                                                              "materialInstanceIds",
                                                              "triangleIds",
                                                              "coverage" };
};
inline constexpr size_t kDebugViewCount = EnumNames<DebugView>::values.size();

/// Load operation of the target.
enum class TargetContents : uint8_t {
    Keep,  ///< kept where the view draws nothing. In a swap chain the view joins the last rendered image
    Clear, ///< all of the target becomes Viewport::clearColor before the view is drawn
};

/// Blending of a view over its target.
enum class ViewBlending : uint8_t {
    Opaque,      ///< replaces the target
    Translucent, ///< blended by the view's alpha, which is that of `clearColor` for background
};

/// The part of a target that a view is drawn to: View::size pixels from `offset`. docs/views.md, "Several views".
struct Viewport {
    uint2 offset{ 0 }; ///< of the first pixel, from the left and from the top; all of the view lies in its target
    TargetContents contents = TargetContents::Keep; ///< of what nothing was drawn to yet: Clear
    ViewBlending blending = ViewBlending::Opaque;
    float4 clearColor{ 0, 0, 0, 1 }; ///< as the target stores it; multiplied by its alpha
};

/// Choice among the levels of detail of geometry (RenderableDesc::levels), for each view and each shadow map by itself.
struct LevelsOfDetail {
    static constexpr float kMostPixels = 64;
    /// How far a level may be from the finest one in the image, in pixels: [0, 64]. In shadow maps as many texels, at
    /// most one. 0: the finest is drawn.
    float pixels = 0;
};

struct View {
    Camera camera{};
    uint2 size{ 1280, 720 }; ///< pixels, >= 1
    DisplayTransform display{};
    Quality quality{};               ///< approximations of shading
    Effects effects{};               ///< screen-space and post-processing effects, each with its switch
    float4 clearColor{ 0, 0, 0, 1 }; ///< background without a skybox; scene-linear and pre-exposed
    uint8_t samples = 1;             ///< of a pixel (MSAA), [1, 4]: 1 or 4
    /// Opaque objects behind RenderableDesc::occluder of others are not drawn, with the same bits; with one sample a
    /// pixel.
    bool occlusionCulling = true;
    LevelsOfDetail lod{};
    DebugView debugView = DebugView::None;
    Aov aov = Aov::None; ///< numbers of the surfaces instead of light, in a render target of RGBA32F; debugView is None
    double timeSeconds = 0; ///< passed to the materials; finite. They see it to a microsecond after years
    /// What getMaterialGlobal0() to getMaterialGlobal3() give to every material of this view.
    std::array<float4, 4> materialGlobals{ { { 0, 0, 0, 1 }, { 0, 0, 0, 1 }, { 0, 0, 0, 1 }, { 0, 0, 0, 1 } } };
    SectionPlanes section{};            ///< planes that cut materials with `sectionPlanes` open
    Layers visibleLayers = kAllLayers;  ///< renderables of other layers are ignored: they cast no shadows, either
    std::optional<Viewport> viewport{}; ///< none: the view covers its target
    /// Drawn over the output; <filament_core/DebugDraw.h>. Until render() returns.
    DebugDraw const* debugDraw = nullptr;
    std::span<const PostProcessPass> postProcess{}; ///< passes of the app, in their order. Until render() returns
};

} // namespace filament_core
