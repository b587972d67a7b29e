// SPDX-License-Identifier: Apache-2.0
// Engine::compile(): requests the programs and pipelines that a material may need from the compile queue.
#include "base/OutOfMemory.h"
#include "filament_core/engine/EngineImpl.h"

#include <algorithm>
#include <bit>

namespace filament_core {

using engine::PublicCall;

namespace {

using engine::CompileJob;
using prepare::DrawPass;

constexpr uint32_t kJointsAttribute = static_cast<uint32_t>(Attribute::Joints);

constexpr uint16_t bitsOf(VariantSet variants) { return static_cast<uint16_t>(variants); }

/// Keys of the package that are in the set. The precision is not part of the set; it follows from the pass.
Result<std::vector<uint8_t>> variantKeys(scene::Material const& material, VariantSet wanted) {
    shader::MaterialPackage const& package = material.package;
    if (wanted != VariantSet::All && (bitsOf(wanted) & package.filteredVariants) != 0)
        return fail(ErrorCode::InvalidArgument, "compile: {}",
                    passes::missingVariant(material.name, package, bitsOf(wanted)));
    std::vector<uint8_t> keys;
    for (shader::Variant const& variant : package.variants) {
        constexpr uint16_t kOfPasses =
                shader::kVariantHalf | shader::kVariantDepth | shader::kVariantMotion | shader::kVariantDebug;
        const bool isOfScene = (variant.key & kOfPasses) == 0;
        if (isOfScene && (variant.key & ~bitsOf(wanted)) == 0) keys.push_back(static_cast<uint8_t>(variant.key));
    }
    return keys;
}

bool hasJoints(scene::GeometryLayout const& layout) {
    const auto attributes = std::span(layout.vertices.attributes).first(layout.vertices.attributeCount);
    return std::ranges::count(attributes, kJointsAttribute, &backend::VertexAttribute::location) > 0;
}

/// One state for each distinct raster state of the instances, and at least that of a new instance.
std::vector<scene::MaterialInstance> instanceStates(Engine::Impl& engine, scene::Material& material) {
    std::vector<scene::MaterialInstance> states;
    const auto add = [&](scene::InstanceRaster const& raster) {
        if (std::ranges::count(states, raster, &scene::MaterialInstance::raster) > 0) return;
        scene::MaterialInstance& state = states.emplace_back();
        state.material = &material;
        state.raster = raster;
    };
    add(scene::initialRaster(material.package));
    engine.instances.forEach([&](scene::MaterialInstance const& instance) {
        if (instance.material == &material) add(instance.raster);
    });
    return states;
}

std::vector<uint16_t> geometryLayouts(Engine::Impl& engine, CompileDesc const& desc) {
    std::vector<uint16_t> layouts;
    for (VertexBuffer buffer : desc.vertices) {
        const uint32_t layout = engine.layouts.intern({ engine.vertexBuffers.get(buffer).layout, desc.primitive });
        layouts.push_back(static_cast<uint16_t>(layout));
    }
    if (!desc.vertices.empty()) return layouts;
    for (uint32_t i = 0; i < engine.layouts.size(); ++i) layouts.push_back(static_cast<uint16_t>(i));
    return layouts;
}

std::span<const DrawPass> passesOf(scene::Material const& material) {
    static constexpr std::array kOne{ DrawPass::Only };
    static constexpr std::array kTwo{ DrawPass::First, DrawPass::Second };
    return material.hasTwoPasses() ? std::span<const DrawPass>(kTwo) : std::span<const DrawPass>(kOne);
}

/// The parts of a request besides pass and variant.
struct Shapes {
    std::vector<uint16_t> layouts;
    uint16_t stateCount = 0;
    bool mirrored = false;
    bool anyMayDeform = false; ///< also vertices without joints: morph targets do not show in their layout
};

void addPipelines(CompileJob& job, Engine::Impl const& engine, Shapes const& shapes, uint32_t slot, uint8_t variant) {
    for (const uint16_t layout : shapes.layouts) {
        const bool deforms = (variant & bitsOf(VariantSet::Skinning)) != 0;
        if (deforms && !shapes.anyMayDeform && !hasJoints(engine.layouts[layout])) continue;
        for (uint16_t state = 0; state < shapes.stateCount; ++state) {
            for (const bool mirrored : { false, true }) {
                if (mirrored && !shapes.mirrored) continue;
                for (const DrawPass pass : passesOf(*job.material))
                    job.requests.push_back({ slot, layout, state, variant, mirrored, pass });
            }
        }
    }
}

/// Whether surfaces are drawn by a variant there.
bool selects(passes::PassSlot const& slot, shader::MaterialPackage const& package, uint8_t variant) {
    if (slot.isFullScreen || slot.stencil) return false; // those with stencil follow from the others
    // Views draw surfaces to one colour at a time. Renderer::prewarm() asks for pipelines of mesh passes.
    const uint32_t attached = (1u << slot.layout.colorCount) - 1;
    if (std::popcount(slot.layout.subpasses[slot.subpass].colorMask & attached) > 1) return false;
    if (slot.transparency != shader::kTransparencyInOrder && !shader::blendsInAnyOrder(package)) return false;
    if (slot.depthOnly)
        return package.findVariant(shader::kVariantDepth) && (variant & ~bitsOf(VariantSet::Skinning)) == 0;
    if (slot.debug != passes::DebugSlot::None)
        return (variant & ~bitsOf(VariantSet::Skinning)) == 0 &&
               (slot.debug == passes::DebugSlot::Edges || package.findVariant(shader::kVariantDebug));
    return passes::shadowFilterOf(slot.shading) != ShadowFilter::Off || (variant & shader::kVariantShadowReceiver) == 0;
}

/// Programs come first, so that the first pipelines wait for nothing else.
void addRequests(CompileJob& job, Engine::Impl& engine, std::span<const uint8_t> variants, Shapes const& shapes) {
    if (std::ranges::all_of(engine.pipelines.slots(), &passes::PassSlot::isFullScreen))
        engine.pipelines.slot({}); // no pass is known: use the default quality
    const auto slots = engine.pipelines.slots();
    shader::MaterialPackage const& package = job.material->package;
    for (const uint8_t variant : variants) {
        for (uint32_t slot = 0; slot < slots.size(); ++slot) {
            if (selects(slots[slot], package, variant)) job.requests.push_back({ .slot = slot, .variant = variant });
        }
    }
    for (const uint8_t variant : variants) {
        for (uint32_t slot = 0; slot < slots.size(); ++slot) {
            const bool isKnown = slots[slot].layout.colorCount > 0 || slots[slot].depthOnly;
            if (isKnown && selects(slots[slot], package, variant)) addPipelines(job, engine, shapes, slot, variant);
        }
    }
}

} // namespace

Result<Compilation> Engine::Impl::compile(Material handle, CompileDesc const& desc) {
    scene::Material& material = materials.get(handle);
    if (material.package.domain != MaterialDomain::Surface) {
        return fail(
                ErrorCode::InvalidArgument,
                "compile: material '{}' is of domain postprocess, which no renderable has; Renderer::prewarm() makes "
                "the pipelines of View::postProcess",
                material.name);
    }
    auto variants = variantKeys(material, desc.variants);
    if (!variants) return variants.error();
    CompileJob job{ .material = &material, .states = instanceStates(*this, material), .onProgress = desc.onProgress };
    addRequests(job, *this, *variants,
                { geometryLayouts(*this, desc), static_cast<uint16_t>(job.states.size()), desc.mirrored,
                  desc.variants != VariantSet::All && isSubset(VariantSet::Skinning, desc.variants) });
    const Compilation compilation = compilations.add(std::move(job), desc.priority);
    return compilation;
}

Result<Compilation> Engine::compile(Material material, CompileDesc const& desc) {
    const PublicCall call(mImpl, "Engine::compile(Material, CompileDesc)");
    return orOutOfMemory("compile", {}, [&] { return mImpl->compile(material, desc); });
}

CompileProgress Engine::progress(Compilation compilation) {
    const PublicCall call(mImpl, "Engine::progress(Compilation)");
    try {
        mImpl->advanceCompilation();
    } catch (std::bad_alloc const&) {
        mImpl->reportOutOfMemory("compile: the next slice is tried again later");
    }
    return mImpl->compilations.progress(compilation);
}

} // namespace filament_core
