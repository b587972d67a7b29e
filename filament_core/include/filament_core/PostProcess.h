// SPDX-License-Identifier: Apache-2.0
/// Post-process passes of the app: a material of `domain : postprocess`, drawn over the picture of a view at a named
/// place of its frame. View::postProcess lists them; docs/own-passes.md explains them.
///   Inputs  parameters of type sampler2d with these names that have no texture of their own:
///             color    the picture so far. With currentPixel : true the pass can be merged with the one before it
///             depth    metres along the view, 1e30 where there is no surface, as RenderTargetDesc::depth
///             normals  of shading, in world space, of opaque surfaces; w is 1 where there is one, less elsewhere
///             history  what this pass made of the renderer's last frame; all 0 in its first one, and if the last one
///                      showed another scene, or had another size
///           All other textures are the app's: Engine::set(). Depth and normals have as many texels as the view draws
///           pixels, which Resolution::scale changes: texture(materialParams_depth, getNormalizedUV()) reads them.
///   Output  the pixel, which replaces the picture.
///   Costs   what the inputs need, and nothing else: normals draw opaque surfaces once more.
///   Fails   a frame with a pass that cannot be drawn is left out; Engine::takeErrors() names the material, the reason
///           and the cure. Debug views and View::aov show the frame without the passes.
///   Limits  a view with passes has no guard band (Effects::guardBand).
#pragma once

#include <filament_core/EnumNames.h>
#include <filament_core/Objects.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace filament_core {

/// Where in the frame a pass is drawn. Those of one place follow each other in the order of the list.
enum class PassPlace : uint8_t {
    AfterOpaque,       ///< light of opaque objects and of the sky; splats and transparent objects follow
    BeforeToneMapping, ///< all light, after temporal anti-aliasing, depth of field and motion blur; before exposure is
                       ///< measured, bloom and grading
    AfterToneMapping,  ///< codes of the display in [0, 1], before FXAA, upscaling, grain and dither
    Last,              ///< what the target stores; View::debugDraw follows
};
template <>
struct EnumNames<PassPlace> {
    static constexpr std::array<std::string_view, 4> values{ "afterOpaque", "beforeToneMapping", "afterToneMapping",
                                                             "last" };
};

struct PostProcessPass {
    MaterialInstance material{}; ///< of domain postprocess, blending opaque
    PassPlace place = PassPlace::BeforeToneMapping;
};

} // namespace filament_core
