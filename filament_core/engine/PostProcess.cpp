// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/PostProcess.h"

#include "base/Suggest.h"
#include "filament_core/engine/materials/TextureParameters.h"
#include "shaders/package/FragmentOutputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <optional>

namespace filament_core::engine {
namespace {

using passes::AppInput;
using passes::AppPass;
using passes::FullScreenInput;
using passes::kAppInputs;
using shader::Parameter;

Error refusedPass(std::string_view material, std::string_view reason) {
    return fail(ErrorCode::InvalidArgument, "a frame is left out: post-process material '{}' {}", material, reason);
}

std::string_view passName(scene::MaterialInstance const& instance) {
    if (!instance.name.empty()) return instance.name;
    return instance.material->name.empty() ? std::string_view("post-process") : instance.material->name;
}

/// The texture that the app has given a parameter; none: it has not.
backend::TextureHandle givenTexture(Engine::Impl& engine, scene::MaterialInstance const& instance,
                                    Parameter const& parameter) {
    const backend::TextureHandle texture =
            instance.textures[textureSlot(instance.material->package, parameter)].texture;
    return texture == engine.textureHandle(engine.unsetTexture(parameter)) ? backend::TextureHandle{} : texture;
}

/// Of the frame: what the app has not given.
std::optional<AppInput> frameInput(Engine::Impl& engine, scene::MaterialInstance const& instance,
                                   Parameter const& parameter) {
    const auto found = std::ranges::find(kAppInputs, parameter.name);
    if (found == kAppInputs.end() || givenTexture(engine, instance, parameter)) return std::nullopt;
    return static_cast<AppInput>(found - kAppInputs.begin());
}

Result<void> checkFrameInput(std::string_view material, Parameter const& parameter, AppInput input) {
    const bool isPlain = parameter.type == ParameterType::Sampler2D && parameter.format == SamplerFormat::Float;
    if (!isPlain)
        return refusedPass(material,
                           fmt::format("has the input '{}' as {}; declare it as {{ type : sampler2d, name : {} }}",
                                       parameter.name, toString(parameter.type), parameter.name));
    if (!parameter.currentPixel || input == AppInput::Color) return {};
    return refusedPass(material, fmt::format("has currentPixel : true for the input '{}', and only color can have it; "
                                             "leave it out, and read the input by texture() or texelFetch()",
                                             parameter.name));
}

Result<void> checkOwnTexture(Engine::Impl& engine, scene::MaterialInstance const& instance, Parameter const& parameter,
                             PassTargets const& to) {
    const std::string_view material = passName(instance);
    if (parameter.type == ParameterType::Sampler2DMS || parameter.type == ParameterType::SubpassInput ||
        parameter.currentPixel)
        return refusedPass(material, fmt::format("reads '{}' as {}, which the app has no textures for; the frame gives "
                                                 "color, depth, normals and history, as sampler2d",
                                                 parameter.name,
                                                 parameter.currentPixel ? "currentPixel" : toString(parameter.type)));
    const backend::TextureHandle texture = givenTexture(engine, instance, parameter);
    if (!texture && to.isAlone)
        return refusedPass(material,
                           fmt::format("has no texture for '{}'; give it one by Engine::set(): a pass without "
                                       "a view has no inputs of its frame",
                                       parameter.name));
    if (!texture)
        return refusedPass(material,
                           fmt::format("has no texture for '{}'; give it one by Engine::set(), or name an input "
                                       "of the frame: color, depth, normals or history{}",
                                       parameter.name, suggestion(parameter.name, kAppInputs)));
    if (std::ranges::find(to.drawn, texture) == to.drawn.end()) return {};
    return refusedPass(material, fmt::format("samples by '{}' what the frame draws to; draw to another render target",
                                             parameter.name));
}

/// Packages without code for Vulkan are taken as they are.
Result<void> checkOutputs(scene::MaterialInstance const& instance, PassTargets const& to) {
    shader::Variant const* variant = instance.material->package.findVariant(0);
    if (!variant || variant->fragment->spirv.empty()) return {};
    const shader::FragmentOutputs outputs = shader::fragmentOutputs(variant->fragment->spirv);
    if (outputs.colors == (1u << to.colors) - 1 && !outputs.depth) return {};
    const char* const cure = to.isAlone ? "give `outputs` of the material and colours of the render target "
                                          "(RenderTargetDesc::others) the same number, from location 0 on"
                                        : "leave `outputs` out, or draw it without a view, into a render target";
    return refusedPass(passName(instance),
                       fmt::format("writes {} colours{}, and is drawn to {}; {}", std::popcount(outputs.colors),
                                   outputs.depth ? " and depth" : "", to.colors, cure));
}

Result<void> checkPassMaterial(scene::MaterialInstance const& instance, PassTargets const& to) {
    shader::MaterialPackage const& package = instance.material->package;
    if (package.domain != MaterialDomain::PostProcess)
        return refusedPass(passName(instance), "is of domain surface; say domain : postprocess in it, or give it to a "
                                               "renderable");
    if (package.blending == Blending::Opaque || to.isAlone) return checkOutputs(instance, to);
    return refusedPass(passName(instance), "blends; leave blending out, read the picture as color and mix in the code");
}

bool isSampled(Parameter const& parameter) { return shader::isTexture(parameter.type) && parameter.isBound; }

/// The nth pass with this instance keeps its own image.
std::string_view historyName(Arena& arena, scene::MaterialInstance const& instance, size_t nth) {
    std::array<char, 48> text{};
    const int length = std::snprintf(text.data(), text.size(), "history %u.%zu", instance.id, nth);
    const std::span kept = arena.copy(std::span<const char>(text).first(static_cast<size_t>(length)));
    return { kept.data(), kept.size() };
}

std::string_view keptName(Arena& arena, std::string_view name) {
    const std::span kept = arena.copy(std::span<const char>(name));
    return { kept.data(), kept.size() };
}

AppPass passOf(Engine::Impl& engine, Arena& arena, View const& view, size_t index) {
    const std::span<const PostProcessPass> all = view.postProcess;
    scene::MaterialInstance const& instance = engine.instances.get(all[index].material);
    shader::MaterialPackage const& package = instance.material->package;
    AppPass pass{ .material = instance.material,
                  .place = all[index].place,
                  .name = keptName(arena, passName(instance)),
                  .parameters = instance.parameters };
    const std::span images = arena.array<FullScreenInput>(package.parameters.size());
    size_t count = 0;
    for (Parameter const& parameter : package.parameters) {
        if (!isSampled(parameter)) continue;
        if (const std::optional<AppInput> input = frameInput(engine, instance, parameter)) {
            pass.reads[static_cast<size_t>(*input)] = true;
            continue;
        }
        scene::TextureBinding const& bound = instance.textures[textureSlot(package, parameter)];
        const backend::SamplerDesc sampler = descOf(samplerFor(parameter, bound.sampler, view.quality.textureFilter));
        images[count++] = { .name = parameter.name,
                            .image = bound.texture,
                            .sampler = engine.samplers.get(sampler, engine.pending) };
    }
    pass.images = images.first(count);
    const auto before = std::ranges::count(all.first(index), all[index].material, &PostProcessPass::material);
    if (pass.has(AppInput::History)) pass.history = historyName(arena, instance, static_cast<size_t>(before));
    return pass;
}

} // namespace

std::span<const PostProcessPass> postProcessOf(View const& view) {
    return view.debugView == DebugView::None && view.aov == Aov::None ? view.postProcess
                                                                      : std::span<const PostProcessPass>{};
}

Result<void> checkPostProcess(Engine::Impl& engine, View const& view, PassTargets const& to) {
    for (PostProcessPass const& pass : postProcessOf(view)) {
        if (!pass.material)
            return fail(ErrorCode::InvalidArgument, "a frame is left out: a pass of View::postProcess has no material; "
                                                    "Engine::createInstance() makes one");
        scene::MaterialInstance const& instance = engine.instances.get(pass.material);
        if (Result<void> fits = checkPassMaterial(instance, to); !fits) return fits;
        for (Parameter const& parameter : instance.material->package.parameters) {
            if (!isSampled(parameter)) continue;
            const std::optional<AppInput> input = to.isAlone ? std::nullopt : frameInput(engine, instance, parameter);
            Result<void> fits = input ? checkFrameInput(passName(instance), parameter, *input)
                                      : checkOwnTexture(engine, instance, parameter, to);
            if (!fits) return fits;
        }
    }
    return {};
}

View viewOfPass(PostProcessPass const& pass, View const& view, uint2 size) {
    View seen{ .camera = view.camera,
               .size = size,
               .timeSeconds = view.timeSeconds,
               .materialGlobals = view.materialGlobals,
               .postProcess = std::span(&pass, 1) };
    seen.quality.textureFilter = view.quality.textureFilter;
    seen.quality.shadows = ShadowFilter::Off;
    return seen;
}

void usePostProcess(Engine::Impl& engine, Arena& arena, View const& view, passes::FrameContext& context) {
    const size_t count = postProcessOf(view).size();
    if (count == 0) return;
    const std::span used = arena.array<AppPass>(count);
    for (size_t i = 0; i < count; ++i) used[i] = passOf(engine, arena, view, i);
    context.appPasses = used;
    // What a pass draws before the frames are accumulated may be another image in each of them.
    if (passes::hasAppPasses(context, PassPlace::AfterOpaque)) context.packet.accumulation.isFixed = false;
}

} // namespace filament_core::engine
