// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/MeshPasses.h"

#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/materials/TextureParameters.h"
#include "shaders/package/FragmentOutputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace filament_core::engine {
namespace {

Error refusedMeshes(scene::MaterialInstance const& instance, std::string_view reason) {
    const std::string_view name = instance.name.empty() ? std::string_view(instance.material->name) : instance.name;
    return fail(ErrorCode::InvalidArgument, "a frame is left out: the material '{}' of a mesh pass {}", name, reason);
}

Result<void> checkMeshMaterial(scene::MaterialInstance const& instance, PassTargets const& to) {
    shader::MaterialPackage const& package = instance.material->package;
    if (package.domain != MaterialDomain::Surface)
        return refusedMeshes(instance, "is of domain postprocess; leave `domain` out of it, or draw it without a scene "
                                       "by render(MaterialInstance, RenderTarget)");
    if (instance.material->isLit())
        return refusedMeshes(instance, "is lit; say shadingModel : unlit in it, or draw lit surfaces by a view");
    shader::Variant const* variant = package.findVariant(0);
    // Packages without code for Vulkan are taken as they are.
    if (!variant || variant->fragment->spirv.empty()) return {};
    const uint32_t colors = shader::fragmentOutputs(variant->fragment->spirv).colors;
    if (colors == (1u << to.colors) - 1) return {};
    return refusedMeshes(instance,
                         fmt::format("writes {} colours, and is drawn to {}; give `outputs` of the material and "
                                     "colours of the render target (RenderTargetDesc::others) the same number, from "
                                     "location 0 on",
                                     std::popcount(colors), to.colors));
}

} // namespace

Result<void> checkMeshPass(Engine::Impl& engine, MeshPass const& pass, PassTargets const& to) {
    if (!pass.material)
        return fail(ErrorCode::InvalidArgument, "a frame is left out: a mesh pass has no material; "
                                                "Engine::createInstance() makes one");
    for (float4 const& clear : pass.clearColors)
        FILAMENT_ASSERT(std::isfinite(clear.x + clear.y + clear.z + clear.w), "clearColors of a mesh pass are finite");
    scene::MaterialInstance const& instance = engine.instances.get(pass.material);
    if (Result<void> fits = checkMeshMaterial(instance, to); !fits) return fits;
    for (shader::Parameter const& parameter : instance.material->package.parameters) {
        if (!shader::isTexture(parameter.type) || !parameter.isBound) continue;
        const backend::TextureHandle texture =
                instance.textures[textureSlot(instance.material->package, parameter)].texture;
        if (texture && std::ranges::find(to.drawn, texture) != to.drawn.end())
            return refusedMeshes(instance,
                                 fmt::format("samples by '{}' what the frame draws to; draw to another render target",
                                             parameter.name));
    }
    return {};
}

Result<void> checkMeshDraws(Engine::Impl& engine, MeshPass const& pass, prepare::ViewPacket const& view) {
    scene::MaterialInstance const& instance = engine.instances.get(pass.material);
    std::optional<uint32_t> checked; // layouts repeat
    for (const std::span<const prepare::DrawCall> draws : { view.opaque, view.blended }) {
        for (prepare::DrawCall const& draw : draws) {
            if (checked == draw.geometry->layout) continue;
            checked = draw.geometry->layout;
            const std::string missing =
                    missingAttributes(*instance.material, engine.layouts[draw.geometry->layout].vertices);
            if (missing.empty()) continue;
            return refusedMeshes(instance,
                                 fmt::format("reads {}, which the vertices of an object in view lack; give them to its "
                                             "mesh, or leave the object out by View::visibleLayers",
                                             missing));
        }
    }
    return {};
}

View viewOfMeshPass(View const& view, uint2 size) {
    View seen{ .camera = view.camera,
               .size = size,
               .occlusionCulling = false, // a material may show what is hidden
               .lod = view.lod,
               .timeSeconds = view.timeSeconds,
               .materialGlobals = view.materialGlobals,
               .visibleLayers = view.visibleLayers };
    seen.quality.textureFilter = view.quality.textureFilter;
    seen.quality.shadows = ShadowFilter::Off;
    seen.quality.reflectionProbes = 0;
    return seen;
}

passes::MeshDraw* meshDrawOf(Engine::Impl& engine, Arena& arena, MeshPass const& pass) {
    scene::MaterialInstance const& instance = engine.instances.get(pass.material);
    const std::string_view name = instance.name.empty() ? std::string_view(instance.material->name) : instance.name;
    const std::span kept = arena.copy(std::span<const char>(name.empty() ? std::string_view("meshes") : name));
    auto* const mesh = arena.make<passes::MeshDraw>();
    mesh->material = &instance;
    mesh->name = { kept.data(), kept.size() };
    mesh->isKept = pass.contents == TargetContents::Keep;
    mesh->keepsHoles = pass.keepsHoles;
    for (size_t i = 0; i < pass.clearColors.size(); ++i) {
        float4 const& clear = pass.clearColors[i];
        mesh->clear[i] = { clear.x, clear.y, clear.z, clear.w };
    }
    return mesh;
}

void requestMeshPipelines(Engine::Impl& engine, passes::MeshDraw const& mesh) {
    CompileJob job{ .material = mesh.material->material };
    scene::MaterialInstance& state = job.states.emplace_back();
    state.material = mesh.material->material;
    state.raster = mesh.material->raster;
    for (prepare::DrawCall const& draw : mesh.draws) {
        const bool deforms = draw.deformation != scene::kNotDeformed;
        const CompileRequest request{ .slot = mesh.slot,
                                      .geometryLayout = static_cast<uint16_t>(draw.geometry->layout),
                                      .variant = deforms ? uint8_t{ shader::kVariantSkinning } : uint8_t{ 0 },
                                      .mirrored = draw.mirrored };
        const bool isKnown = std::ranges::any_of(job.requests, [&](CompileRequest const& known) {
            return known.geometryLayout == request.geometryLayout && known.variant == request.variant &&
                   known.mirrored == request.mirrored;
        });
        if (!isKnown) job.requests.push_back(request);
    }
    engine.compilations.add(std::move(job), CompilePriority::Critical);
}

} // namespace filament_core::engine
