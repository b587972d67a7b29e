// SPDX-License-Identifier: Apache-2.0
/// View: a camera and the settings of its image. A plain value; its options by name: setOption() (Options.h).
#pragma once

#include <filament/Camera.h>
#include <filament/ColorGrading.h>
#include <filament/Effects.h>
#include <filament/Objects.h>
#include <filament/Options.h>
#include <filament/Quality.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace filament {

class DebugDraw;

/// What the engine decides for each pixel, what materials are made of, or which numbers the picture has, instead of the
/// picture: for tools and tests. docs/debug-views.md says what the colours mean and which page explains the others;
/// <filament/DebugViews.h> has them as values. Such a frame has one sample a pixel and no tone mapper.
enum class DebugView : uint8_t {
    None,
    Cascades,          ///< the picture in grey, tinted by the cascade of the sun that shades each pixel
    Atlas,             ///< the atlas of shadow maps: depths, and the outlines of its tiles
    Froxels,           ///< how many lights the list of each pixel's froxel has
    Lights,            ///< how many lights of the list reach each pixel: those whose range and cone contain it
    Occlusion,         ///< the visibility that ambient occlusion computes
    BentNormals,       ///< the mean direction that is open, in the world
    Reflections,       ///< how far reflected rays go until they hit something in the picture
    Refraction,        ///< the blurred level of the picture that is seen through each refracting pixel
    Fog,               ///< the share of each pixel that is fog
    Motion,            ///< from where the last frame showed each pixel to where it is now
    CircleOfConfusion, ///< how blurred depth of field makes each pixel, before and behind the focus
    HistoryWeight,     ///< how much of the gathered picture temporal anti-aliasing keeps in each pixel
    Histogram,         ///< what auto exposure measures, and the exposure that it chooses
    // The picture in numbers:
    Luminance, ///< stops above or below middle grey
    Numerics,  ///< NaN, infinities, what half floats cannot hold or hold coarsely, and what is shown as full
    // What the code of materials gives, of the surface that is seen:
    BaseColor,
    Roughness, ///< perceptual
    Metallic,
    Normals,            ///< that shading uses, in the world
    Tangents,           ///< in the world
    TextureCoordinates, ///< the first ones
    MaterialOcclusion,  ///< of the material; Occlusion is that of the screen
    Emissive,           ///< pre-exposed
    MipLevel,           ///< at which a texture of 1024 texels a side would be read by the first coordinates
    // What drawing them costs:
    Overdraw,          ///< how many fragments are shaded in each pixel
    TransparentLayers, ///< how many surfaces that blend are seen in each pixel
    Wireframe,         ///< the edges of visible triangles, over the picture
    WireframeAlone,    ///< the same without the picture
};
template <>
struct EnumNames<DebugView> {
    static constexpr std::array<std::string_view, 29> values{ "none",
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
                                                              "wireframeAlone" };
};
inline constexpr size_t kDebugViewCount = EnumNames<DebugView>::values.size();

/// Load operation of the target.
enum class TargetContents : uint8_t {
    Keep,  ///< they stay where the view draws nothing. In a swap chain the view joins the image that was rendered last
    Clear, ///< all of the target becomes Viewport::clearColor before the view is drawn
};

/// How a view is drawn over what its target has.
enum class ViewBlending : uint8_t {
    Opaque,      ///< in its place
    Translucent, ///< shown through it by the view's alpha, which is that of `clearColor` where nothing is drawn
};

/// The part of a target that a view is drawn to: View::size pixels from `offset`. docs/views.md, "Several views".
struct Viewport {
    uint2 offset{ 0 }; ///< of the first pixel, from the left and from the top; all of the view lies in its target
    TargetContents contents = TargetContents::Keep; ///< of what nothing was drawn to yet: Clear
    ViewBlending blending = ViewBlending::Opaque;
    float4 clearColor{ 0, 0, 0, 1 }; ///< as the target stores it; multiplied by its alpha
};

struct View {
    Camera camera{};
    uint2 size{ 1280, 720 }; ///< pixels, >= 1
    ColorGrading colorGrading{};
    Quality quality{};               ///< the approximations that shading uses
    Effects effects{};               ///< screen-space and post-processing effects, each with its switch
    float4 clearColor{ 0, 0, 0, 1 }; ///< background without a skybox; scene-linear and pre-exposed
    uint8_t samples = 1;             ///< MSAA: 1 or 4
    DebugView debugView = DebugView::None;
    double timeSeconds = 0; ///< passed to the materials; finite. They see it to a microsecond after years
    /// What getMaterialGlobal0() to getMaterialGlobal3() give to every material of this view.
    std::array<float4, 4> materialGlobals{ { { 0, 0, 0, 1 }, { 0, 0, 0, 1 }, { 0, 0, 0, 1 }, { 0, 0, 0, 1 } } };
    Layers visibleLayers = kAllLayers;  ///< renderables of other layers are not there: they cast no shadows, either
    std::optional<Viewport> viewport{}; ///< none: the view is all of its target
    /// Drawn over the finished picture; <filament/DebugDraw.h>. Until render() returns.
    DebugDraw const* debugDraw = nullptr;
};

} // namespace filament
