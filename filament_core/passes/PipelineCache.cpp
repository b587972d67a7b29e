// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PipelineCache.h"

#include "base/Result.h"
#include "filament_core/passes/RasterStates.h"
#include "filament_core/prepare/ShadowMaps.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/FragmentOutputs.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>

namespace filament_core::passes {
namespace {

using namespace backend;

constexpr uint32_t kNoGeometry = 0xFFF;

// always 1 | unused 2 bits | raster state 5 | pass 2 | material 20 | geometry layout 12 | slot 12 | variant 8 | culling
// off 1 | mirrored 1
uint64_t makeKey(uint32_t material, uint32_t geometryLayout, uint32_t slot, uint8_t variant, bool cullingDisabled,
                 bool mirrored) {
    FILAMENT_ASSERT(material < 1u << 20 && geometryLayout <= kNoGeometry && slot < 4096,
                    "at most 2^20 materials, 4095 vertex layouts and 4096 passes with their shading");
    return uint64_t{ 1 } << 63 | static_cast<uint64_t>(material) << 34 | static_cast<uint64_t>(geometryLayout) << 22 |
           static_cast<uint64_t>(slot) << 10 | static_cast<uint64_t>(variant) << 2 |
           static_cast<uint64_t>(cullingDisabled) << 1 | static_cast<uint64_t>(mirrored);
}

// A material compiled without shadows, or without those of a filter, is drawn without them.
uint8_t neededVariant(scene::Material const& material, uint8_t variant, ShadowFilter filter) {
    const bool mayReceive = prepare::canReceiveShadows(material, filter);
    const int shadows = mayReceive ? shader::kVariantShadowReceiver : 0;
    const int others = material.isLit() ? ~shader::kVariantShadowReceiver : shader::kVariantSkinning;
    return static_cast<uint8_t>(variant & (others | shadows));
}

// Materials without half-precision variants are lit in full precision.
uint16_t withPrecision(scene::Material const& material, uint8_t variant, ShadingPrecision precision) {
    const auto half = static_cast<uint16_t>(variant | shader::kVariantHalf);
    return precision == ShadingPrecision::Half && material.package.findVariant(half) ? half : variant;
}

// Everything except cullingDisabled.
uint64_t rasterBits(scene::InstanceRaster const& raster) {
    return static_cast<uint64_t>(raster.culling) | static_cast<uint64_t>(raster.colorWrite) << 2 |
           static_cast<uint64_t>(raster.depthWrite) << 3 | static_cast<uint64_t>(raster.depthCulling) << 4;
}

scene::InstanceRaster rasterIn(PassSlot const& slot, scene::MaterialInstance const& instance) {
    scene::InstanceRaster raster = slot.isShadowMap ? scene::inShadowMaps(instance.raster) : instance.raster;
    raster.cullingDisabled |= slot.cutsSections && instance.material->package.sectionPlanes;
    return raster;
}

uint64_t makeKey(uint32_t slot, PipelineUse const& use, scene::InstanceRaster const& raster) {
    scene::Material const& material = *use.instance.material;
    return rasterBits(raster) << 56 | static_cast<uint64_t>(use.pass) << 54 |
           makeKey(material.id, use.geometryLayout, slot, neededVariant(material, use.variant, ShadowFilter::Pcf3),
                   raster.cullingDisabled, use.mirrored);
}

uint64_t fullscreenKey(uint32_t slot, scene::Material const& material) {
    return makeKey(material.id, kNoGeometry, slot, 0, true, false);
}

// A material that reads only the current pixel is merged if its pass is. The pipeline's key need not contain this,
// because the slot determines it.
uint16_t fullscreenVariant(PassSlot const& slot, shader::MaterialPackage const& package) {
    // A depth variant of a full-screen material empties tiles of the shadow atlas.
    if (slot.depthOnly) return shader::kVariantDepth;
    const bool isMerged = slot.layout.subpasses[slot.subpass].inputMask != 0;
    return isMerged && package.findVariant(shader::kVariantMerged) ? uint16_t{ shader::kVariantMerged } : uint16_t{ 0 };
}

// Skies have fog; what processes images has not.
ShadingKey fullscreenShading(PassSlot const& slot, shader::MaterialPackage const& package) {
    const bool isSurface = package.domain == shader::MaterialDomain::Surface && !slot.depthOnly;
    return isSurface ? withoutMipBias(ofUnlit(slot.shading)) : ShadingKey{ 0 };
}

uint64_t programKey(uint16_t variant, ShadingKey shading, bool isOfEdges = false) {
    constexpr uint64_t kOfEdges = 1 << 15; // no VariantBit
    static_assert((shader::kAllVariantBits & kOfEdges) == 0);
    return uint64_t{ shading } << 16 | variant | (isOfEdges ? kOfEdges : 0);
}

// The alpha of lit materials does not depend on light.
bool needsNoLight(shader::TransparencyTerm term) {
    return term == shader::kTransparencyCover || term == shader::kTransparencyDepth ||
           term == shader::kTransparencyNextDepth;
}

bool hasStencilTest(PassSlot const& slot, scene::InstanceRaster const& raster) {
    if (slot.stencil || slot.depthOnly) return false; // of passes with values of their own
    return raster.stencil && hasStencil(slot.layout.depthFormat) && slot.layout.subpasses[slot.subpass].usesDepth;
}

/// References are bound with the draw: states that differ in them share pipelines.
PassSlot withStencil(PassSlot slot, StencilState state) {
    state.front.reference = state.back.reference = 0;
    slot.stencil = state;
    return slot;
}

/// Whether a surface has `outputs` that the slot has no colours for. Packages without code for Vulkan are taken as they
/// are.
bool writesOtherColors(PassSlot const& slot, shader::MaterialPackage const& package, uint16_t variant) {
    shader::Variant const* code = package.findVariant(variant);
    if (!code || slot.edges || slot.layout.colorCount == 0) return false;
    const uint32_t colors = slot.layout.subpasses[slot.subpass].colorMask & ((1u << slot.layout.colorCount) - 1);
    return (shader::fragmentOutputs(code->fragment->spirv).colors & ~colors & ~1u) != 0;
}

std::string otherColors(scene::Material const& material) {
    return fmt::format("material '{}' has several outputs, and views draw to one colour: draw the objects that have it "
                       "by a mesh pass, Renderer::render(Scene, MeshPass, RenderTarget), or leave 'outputs' out",
                       material.name);
}

constexpr VariantSet variantSet(uint32_t bits) { return static_cast<VariantSet>(bits) & VariantSet::All; }

} // namespace

std::string missingVariant(std::string_view material, shader::MaterialPackage const& package, uint32_t variant) {
    if ((variant & shader::kVariantDebug) != 0 && !package.findVariant(shader::kVariantDebug)) {
        const bool isFiltered = (package.filteredVariants & shader::kVariantDebug) != 0;
        return fmt::format("material '{}' has no variant 'debugViews': this debug view does not show it; compile it "
                           "again {}",
                           material,
                           isFiltered ? "without that filter (variantFilter)" : "with the matc of this engine");
    }
    const VariantSet filtered = variantSet(package.filteredVariants) & variantSet(variant);
    if (filtered == VariantSet::None) {
        return fmt::format("material '{}' has no variant '{}': it is not drawn; compile it again with the matc of this "
                           "engine",
                           material, toString(variantSet(variant)));
    }
    return fmt::format("material '{}': variant '{}' is asked for, but it was compiled without '{}' (variantFilter): it "
                       "is not drawn; compile it without that filter",
                       material, toString(variantSet(variant)), toString(filtered));
}

std::optional<uint32_t> PipelineCache::findSlot(PassSlot const& slot) const {
    const auto found = std::find(mSlots.begin(), mSlots.end(), slot);
    return found != mSlots.end() ? std::optional(static_cast<uint32_t>(found - mSlots.begin())) : std::nullopt;
}

uint32_t PipelineCache::slot(PassSlot const& slot) {
    if (const std::optional<uint32_t> known = findSlot(slot)) return *known;
    mSlots.push_back(slot);
    return static_cast<uint32_t>(mSlots.size() - 1);
}

uint32_t PipelineCache::slotOfFields(uint32_t slot) {
    PassSlot const& plain = mSlots[slot];
    if (plain.depthOnly || plain.motionOnly || plain.debug != DebugSlot::None) return slot; // nothing is lit
    PassSlot lit = plain;
    lit.shading = withField(lit.shading);
    return this->slot(lit);
}

PipelineCache::Program const* PipelineCache::findProgram(scene::Material const& material, uint64_t key) const {
    const auto state = mMaterials.find(material.id);
    if (state == mMaterials.end()) return nullptr;
    const auto found = std::ranges::find(state->second.programs, key, &Program::key);
    return found == state->second.programs.end() ? nullptr : &*found;
}

size_t PipelineCache::programCount(scene::Material const& material) const {
    const auto state = mMaterials.find(material.id);
    return state == mMaterials.end() ? 0 : state->second.programs.size();
}

ProgramHandle PipelineCache::programFor(CommandBuffer& setup, scene::Material const& material, uint16_t variant,
                                        ShadingKey shading, scene::Material const* edges) {
    const uint64_t key = programKey(variant, shading, edges != nullptr);
    if (Program const* program = findProgram(material, key)) return program->handle;
    shader::Variant const* code = material.package.findVariant(variant);
    if (!code) return refuse(material, variant, missingVariant(material.name, material.package, variant));
    std::vector<Program>& programs = mMaterials[material.id].programs;
    // Room for it comes first. If recording fails, the entry leaves again.
    programs.push_back({ key, {} });
    try {
        shader::Variant const& fragment = edges ? *edges->package.findVariant(0) : *code;
        programs.back().handle = createProgram(setup, material, *code, shading, fragment);
    } catch (...) {
        programs.pop_back(); // only recorded programs are known
        throw;
    }
    return programs.back().handle;
}

PipelineCache::ProgramChoice PipelineCache::choose(uint32_t slot, scene::Material const& material,
                                                   uint8_t variant) const {
    ProgramChoice choice = chooseWithTextures(slot, material, variant);
    if (!material.package.hasTextures()) choice.shading = withoutMipBias(choice.shading);
    return choice;
}

PipelineCache::ProgramChoice PipelineCache::chooseWithTextures(uint32_t slot, scene::Material const& material,
                                                               uint8_t variant) const {
    PassSlot const& at = mSlots[slot];
    if (at.depthOnly) {
        const auto depth = static_cast<uint16_t>(shader::kVariantDepth | (variant & shader::kVariantSkinning));
        return { depth, shader::transmitsLight(material.package) ? at.shading : depthOfViewKey(at.shading) };
    }
    if (at.motionOnly)
        return { static_cast<uint16_t>(shader::kVariantMotion | (variant & shader::kVariantSkinning)), 0 };
    if (at.debug != DebugSlot::None) {
        const int values = at.edges ? 0 : shader::kVariantDebug;
        return { static_cast<uint16_t>(values | (variant & shader::kVariantSkinning)), depthOfViewKey(at.shading) };
    }
    if (material.isLit() && needsNoLight(at.transparency))
        return { static_cast<uint16_t>(variant & shader::kVariantSkinning),
                 withTransparency(ofBoundTextures(at.shading), at.transparency) };
    // From here on, choices that this program does not read leave its key. Passes and settings that differ in nothing
    // else share the program.
    const uint8_t needed = neededVariant(material, variant, shadowFilterOf(at.shading));
    const bool isShadowed = (needed & shader::kVariantShadowReceiver) != 0;
    ShadingKey shading = material.isLit() || isShadowed ? at.shading : ofUnlit(at.shading);
    if ((needed & shader::kVariantPunctual) == 0) shading = withoutLightList(shading);
    if (material.package.refractionMode != shader::RefractionMode::ScreenSpace) shading = withoutRefraction(shading);
    if (material.package.reflections != shader::Reflections::ScreenSpace) shading = withoutReflections(shading);
    shading = withTransparency(isShadowed ? shading : withoutShadows(shading), at.transparency);
    return { withPrecision(material, needed, at.precision), shading };
}

void PipelineCache::prepareProgram(CommandBuffer& setup, uint32_t slot, scene::Material const& material,
                                   uint8_t variant) {
    (void)surfaceProgram(setup, slot, material, variant);
}

bool PipelineCache::hasProgram(uint32_t slot, scene::Material const& material, uint8_t variant) const {
    const ProgramChoice choice = choose(slot, material, variant);
    return findProgram(material, programKey(choice.variant, choice.shading, mSlots[slot].edges)) != nullptr;
}

ProgramHandle PipelineCache::surfaceProgram(CommandBuffer& setup, uint32_t slot, scene::Material const& material,
                                            uint8_t variant) {
    const ProgramChoice choice = choose(slot, material, variant);
    if (material.package.domain == shader::MaterialDomain::Surface) {
        if (writesOtherColors(mSlots[slot], material.package, choice.variant))
            return refuse(material, choice.variant, otherColors(material));
        return programFor(setup, material, choice.variant, choice.shading, mSlots[slot].edges);
    }
    return refuse(material, choice.variant,
                  fmt::format("material '{}' is of domain postprocess: it draws pictures, not the surfaces of "
                              "renderables; leave out 'domain' in its definition",
                              material.name));
}

/// Reported once per variant, however many pipelines would have needed it.
ProgramHandle PipelineCache::refuse(scene::Material const& material, uint16_t variant, std::string why) {
    std::vector<uint16_t>& refused = mMaterials[material.id].refusedVariants;
    if (std::ranges::count(refused, variant) > 0) return {};
    mRefusals.reserve(mRefusals.size() + 1); // so that either both happen or neither
    refused.push_back(variant);
    mRefusals.push_back(std::move(why));
    return {};
}

ProgramHandle PipelineCache::createProgram(CommandBuffer& setup, scene::Material const& material,
                                           shader::Variant const& code, ShadingKey shading,
                                           shader::Variant const& fragment) {
    std::vector<ConstantValue> constants = material.constants;
    if (shading != 0) { // 0: the program's own defaults
        for (ConstantValue const& constant : shadingConstants(shading)) constants.push_back(constant);
    }
    if (material.package.domain == shader::MaterialDomain::Surface) {
        for (ConstantValue const& constant : shader::variantConstants(code.key)) constants.push_back(constant);
    }
    const bool spirv = mStream.info().shaderLanguage == ShaderLanguage::SpirV;
    ProgramDesc desc{ .constants = constants,
                      .layout = shader::programLayout(material.package, code.key),
                      .debugName = material.name };
    desc.vertex = spirv ? std::as_bytes(std::span(code.vertex->spirv)) : std::as_bytes(std::span(code.vertex->essl));
    desc.fragment = spirv ? std::as_bytes(std::span(fragment.fragment->spirv))
                          : std::as_bytes(std::span(fragment.fragment->essl));
    NewHandle program(mStream, mStream.allocateProgram());
    setup.record(CmdCreateProgram{ program, desc });
    return program.keep();
}

PipelineHandle PipelineCache::create(CommandBuffer& setup, uint64_t key, PipelineDesc const& desc, uint32_t material) {
    mPipelines.reserveOne(); // only recorded pipelines are known
    NewHandle handle(mStream, mStream.allocatePipeline());
    setup.record(CmdCreatePipeline{ handle, desc });
    mPipelines.insert({ key, handle, material });
    return handle.keep();
}

std::optional<PipelineHandle> PipelineCache::find(uint32_t slot, PipelineUse const& use) const {
    if (hasStencilTest(mSlots[slot], use.instance.raster)) {
        const std::optional<uint32_t> own = findSlot(withStencil(mSlots[slot], *use.instance.raster.stencil));
        if (!own) return std::nullopt;
        slot = *own;
    }
    const uint64_t key = makeKey(slot, use, rasterIn(mSlots[slot], use.instance));
    PipelineTable::Entry const* entry = mPipelines.find(key);
    return entry ? std::optional(entry->handle) : std::nullopt;
}

PipelineHandle PipelineCache::pipelineFor(CommandBuffer& setup, uint32_t slot, PipelineUse const& use) {
    if (hasStencilTest(mSlots[slot], use.instance.raster))
        slot = this->slot(withStencil(mSlots[slot], *use.instance.raster.stencil));
    const scene::InstanceRaster raster = rasterIn(mSlots[slot], use.instance);
    const uint64_t key = makeKey(slot, use, raster);
    if (PipelineTable::Entry const* entry = mPipelines.find(key)) return entry->handle;

    scene::Material const& material = *use.instance.material;
    const ProgramHandle program = surfaceProgram(setup, slot, material, use.variant);
    if (!program) {
        mPipelines.insert({ key, {}, material.id }); // do not ask again
        return {};
    }
    PipelineDesc desc = surfaceStates(mSlots[slot], use, raster, mLayouts[use.geometryLayout]);
    desc.program = program;
    return create(setup, key, desc, material.id);
}

std::optional<PipelineHandle> PipelineCache::findFullscreen(uint32_t slot, scene::Material const& material) const {
    PipelineTable::Entry const* entry = mPipelines.find(fullscreenKey(slot, material));
    return entry ? std::optional(entry->handle) : std::nullopt;
}

PipelineHandle PipelineCache::fullscreenPipeline(CommandBuffer& setup, uint32_t slot, scene::Material const& material) {
    const uint64_t key = fullscreenKey(slot, material);
    if (PipelineTable::Entry const* entry = mPipelines.find(key)) return entry->handle;
    PipelineDesc desc = fullScreenStates(mSlots[slot], material);
    desc.program = programFor(setup, material, fullscreenVariant(mSlots[slot], material.package),
                              fullscreenShading(mSlots[slot], material.package));
    FILAMENT_ASSERT(desc.program, "a full-screen material has variant 0");
    return create(setup, key, desc, material.id);
}

void PipelineCache::forget(CommandBuffer& commands, scene::Material const& material) {
    mPipelines.eraseIf([&](PipelineTable::Entry const& entry) {
        if (entry.material != material.id) return false;
        if (entry.handle) {
            mStream.destroy(commands, entry.handle);
        }
        return true;
    });
    const auto state = mMaterials.find(material.id);
    if (state == mMaterials.end()) return;
    // After the pipelines, which were made of them.
    for (Program const& program : state->second.programs) mStream.destroy(commands, program.handle);
    mMaterials.erase(state);
}

} // namespace filament_core::passes
