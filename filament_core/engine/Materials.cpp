// SPDX-License-Identifier: Apache-2.0
// Materials and their instances: packages -> programs, named parameters -> uniform blocks and bind groups.
#include "filament_core/base/Log.h"
#include "filament_core/base/OutOfMemory.h"
#include "filament_core/base/Result.h"
#include "filament_core/base/Suggest.h"
#include "filament_core/engine/DescribeMaterial.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/Parameters.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/EngineMaterials.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace filament {
namespace {

using namespace backend;
using shader::Parameter;
using shader::ParameterType;

ConstantValue::Type typeOf(std::variant<bool, int32_t, float> const& value) {
    switch (value.index()) {
    case 0:
        return ConstantValue::Type::Bool;
    case 1:
        return ConstantValue::Type::Int;
    default:
        return ConstantValue::Type::Float;
    }
}

uint32_t bitsOf(std::variant<bool, int32_t, float> const& value) {
    switch (value.index()) {
    case 0:
        return std::get<bool>(value) ? 1u : 0u;
    case 1:
        return static_cast<uint32_t>(std::get<int32_t>(value));
    default:
        return std::bit_cast<uint32_t>(std::get<float>(value));
    }
}

const char* typeName(ConstantValue::Type type) {
    switch (type) {
    case ConstantValue::Type::Bool:
        return "bool";
    case ConstantValue::Type::Int:
        return "int";
    case ConstantValue::Type::Float:
        return "float";
    }
    return "unknown";
}

template <class Items>
std::vector<std::string_view> namesOf(Items const& items) {
    std::vector<std::string_view> names;
    for (auto const& item : items) names.push_back(item.name);
    return names;
}

Result<std::vector<ConstantValue>> resolveConstants(shader::MaterialPackage const& package,
                                                    std::vector<MaterialConstant> const& given) {
    std::vector<ConstantValue> values;
    for (MaterialConstant const& constant : given) {
        shader::Constant const* known = package.findConstant(constant.name);
        if (!known) {
            return fail(ErrorCode::NotFound, "material '{}' has no constant '{}'{}", package.name, constant.name,
                        suggestion(constant.name, namesOf(package.constants)));
        }
        if (known->type != typeOf(constant.value)) {
            return fail(ErrorCode::InvalidArgument, "constant '{}' of material '{}' is {}, but was given {}",
                        constant.name, package.name, typeName(known->type), typeName(typeOf(constant.value)));
        }
        values.push_back({ known->id, bitsOf(constant.value), known->type });
    }
    return values;
}

Error unknownParameter(scene::Material const& material, std::string_view name) {
    return fail(ErrorCode::NotFound, "material '{}' has no parameter '{}'{}", material.name, name,
                suggestion(name, namesOf(material.package.parameters)));
}

// Position of a texture parameter among the texture parameters.
size_t textureSlot(shader::MaterialPackage const& package, Parameter const& parameter) {
    size_t slot = 0;
    for (Parameter const& at : package.parameters) {
        if (&at == &parameter) break;
        slot += shader::isTexture(at.type);
    }
    return slot;
}

const char* kindName(TextureType type) {
    switch (type) {
    case TextureType::Texture2D:
        return "a 2D texture";
    case TextureType::Texture2DArray:
        return "an array";
    case TextureType::Cube:
        return "a cube";
    }
    return "a texture";
}

TextureType kindOf(ParameterType sampler) {
    if (sampler == ParameterType::SamplerCube) return TextureType::Cube;
    return sampler == ParameterType::Sampler2DArray ? TextureType::Texture2DArray : TextureType::Texture2D;
}

shader::SamplerFormat samplerFormatOf(Format format) {
    switch (formatInfo(format).kind) {
    case FormatKind::UnsignedInteger:
        return shader::SamplerFormat::Uint;
    case FormatKind::SignedInteger:
        return shader::SamplerFormat::Int;
    default:
        return shader::SamplerFormat::Float;
    }
}

/// The screen's own colour cannot be sampled yet.
void explainScreenSpace(scene::Material const& material) {
    const auto say = [&](const char* property) {
        log(Severity::Info, "material '{}': {} : screenspace shows the environment only in this version", material.name,
            property);
    };
    if (material.package.reflections == shader::Reflections::ScreenSpace) say("reflections");
    if (material.package.refractionMode == shader::RefractionMode::ScreenSpace) say("refractionMode");
}

Result<scene::Material> loadMaterial(MaterialDesc const& desc) {
    auto package = shader::readPackage(desc.package);
    if (!package) {
        return fail(package.error().code, "material package '{}': {}", desc.name, package.error().message);
    }
    auto constants = resolveConstants(*package, desc.constants);
    if (!constants) return constants.error();
    scene::Material material;
    material.name = desc.name.empty() ? package->name : desc.name;
    material.package = std::move(*package);
    material.constants = std::move(*constants);
    material.description = engine::describeMaterial(material);
    return material;
}

// Whole numbers have nothing between them.
Sampler unfiltered(Sampler sampler) {
    sampler.magFilter = sampler.minFilter = Filter::Nearest;
    if (sampler.mipFilter == MipFilter::Linear) sampler.mipFilter = MipFilter::Nearest;
    sampler.anisotropy = 1;
    return sampler;
}

Sampler filtered(Sampler sampler, TextureFilter filter) {
    if (filter == TextureFilter::AsAuthored) return sampler;
    sampler.magFilter = sampler.minFilter = Filter::Linear;
    sampler.mipFilter = filter == TextureFilter::Bilinear ? MipFilter::Nearest : MipFilter::Linear;
    sampler.anisotropy = filter == TextureFilter::Anisotropic ? 16 : 1;
    return sampler;
}

} // namespace

// Bind groups name their samplers: those of all instances are made anew, and only when the choice changes.
void Engine::Impl::useTextureFilter(TextureFilter filter) {
    if (filter == textureFilter) return;
    instances.forEachHandle([&](MaterialInstance handle, scene::MaterialInstance& instance) {
        if (instance.textures.empty()) return;
        markDirty(handle);
        instance.texturesDirty = true;
    });
    textureFilter = filter;
}

Result<Material> Engine::Impl::createMaterial(MaterialDesc const& desc) {
    auto loaded = loadMaterial(desc);
    if (!loaded) return loaded.error();
    const bool isFlat = loaded->package.interpolation == shader::Interpolation::Flat;
    if (isFlat && !stream->info().features.lastVertexProvokes) {
        return fail(ErrorCode::Unsupported,
                    "material '{}': interpolation : flat takes the last vertex of a triangle, and {} can only take the "
                    "first (it lacks VK_EXT_provoking_vertex); use interpolation : smooth",
                    loaded->name, device.device);
    }
    explainScreenSpace(*loaded);
    loaded->id = nextMaterialId++;
    return materials.add(std::move(*loaded));
}

std::span<const std::byte> Engine::Impl::enginePackage(std::string_view name) const {
    return shader::engineMaterial(name, options.exactShaders ? shader::Arithmetic::Exact : shader::Arithmetic::Plain);
}

Material Engine::Impl::engineMaterial(std::string_view package, std::vector<MaterialConstant> constants) {
    std::string key(package);
    for (MaterialConstant const& constant : constants) key += '/' + std::to_string(bitsOf(constant.value));
    if (const auto found = engineMaterials.find(key); found != engineMaterials.end()) return found->second;
    auto material = createMaterial({ enginePackage(package), std::move(constants), key });
    FILAMENT_ASSERT(material.ok(), "the engine's own materials are well formed");
    try {
        engineMaterials.emplace(key, *material);
    } catch (...) {
        materials.remove(*material);
        throw;
    }
    return *material;
}

MaterialInstance Engine::Impl::createInstance(Material material, std::string name) {
    scene::Material& parent = materials.get(material);
    engine::Draft draft(instances);
    scene::MaterialInstance& instance = draft.state();
    instance.material = &parent;
    instance.name = name.empty() ? parent.name : std::move(name);
    instance.parameters.resize(parent.package.uniformBytes);
    instance.raster = scene::initialRaster(parent.package);
    if (Parameter const* threshold = parent.package.findParameter(shader::kMaskThresholdParameter)) {
        std::memcpy(instance.parameters.data() + threshold->offset, &parent.package.maskThreshold, sizeof(float));
    }
    if (Parameter const* doubleSided = parent.package.findParameter(shader::kDoubleSidedParameter)) {
        const uint32_t isDoubleSided = parent.package.doubleSided;
        std::memcpy(instance.parameters.data() + doubleSided->offset, &isDoubleSided, sizeof(isDoubleSided));
    }
    for (Parameter const& parameter : parent.package.parameters) {
        if (shader::isTexture(parameter.type))
            instance.textures.push_back({ textureHandle(unsetTexture(parameter)), {} });
    }
    dirtyInstances.push_back(draft.handle()); // the last that may fail
    instance.id = nextInstanceId++;
    ++parent.instanceCount;
    return draft.keep();
}

void Engine::Impl::markDirty(MaterialInstance handle) {
    scene::MaterialInstance const& instance = instances.get(handle);
    if (!instance.parametersDirty && !instance.texturesDirty) dirtyInstances.push_back(handle);
}

template <class Write>
Result<void> Engine::Impl::change(MaterialInstance handle, std::string_view name, Write&& write) {
    scene::MaterialInstance& instance = instances.get(handle);
    Parameter const* parameter = instance.material->package.findParameter(name);
    if (!parameter) return unknownParameter(*instance.material, name);
    const size_t listed = dirtyInstances.size();
    markDirty(handle);
    Result<void> written = write(instance, *parameter);
    if (written)
        instance.parametersDirty = true;
    else
        dirtyInstances.resize(listed); // never grows: markDirty() added one at most
    return written;
}

Result<void> Engine::Impl::set(MaterialInstance handle, std::string_view name, ParameterValue const& value) {
    return change(handle, name, [&](scene::MaterialInstance& instance, Parameter const& parameter) {
        return engine::writeParameter(*instance.material, parameter, value, instance.parameters);
    });
}

Result<void> Engine::Impl::set(MaterialInstance handle, std::string_view name, ParameterArray const& values,
                               uint32_t first) {
    return change(handle, name, [&](scene::MaterialInstance& instance, Parameter const& parameter) {
        return engine::writeParameters(*instance.material, parameter, values, first, instance.parameters);
    });
}

Result<void> Engine::Impl::checkTexture(scene::Material const& material, Parameter const& parameter, Texture texture) {
    const char* const declared = toString(parameter.type);
    if (!shader::isTexture(parameter.type) || parameter.type == ParameterType::SubpassInput) {
        return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is {}, not a sampler", parameter.name,
                    material.name, declared);
    }
    engine::TextureState const& state = textures.get(texture);
    if (state.desc.type != kindOf(parameter.type)) {
        return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is {}, but texture '{}' is {}",
                    parameter.name, material.name, declared, state.name, kindName(state.desc.type));
    }
    // A sampler reads what it is declared for: the APIs leave the rest undefined.
    static constexpr const char* kFormats[] = { "float", "int", "uint" };
    const shader::SamplerFormat format = samplerFormatOf(state.desc.format);
    if (format == parameter.format) return {};
    return fail(ErrorCode::InvalidArgument,
                "parameter '{}' of material '{}' is a sampler of format {}, and texture '{}' has the format {}, which "
                "is read with format : {}",
                parameter.name, material.name, kFormats[static_cast<size_t>(parameter.format)], state.name,
                formatInfo(state.desc.format).name, kFormats[static_cast<size_t>(format)]);
}

Result<void> Engine::Impl::set(MaterialInstance handle, std::string_view name, Texture texture, Sampler sampler) {
    scene::MaterialInstance& instance = instances.get(handle);
    shader::MaterialPackage const& package = instance.material->package;
    Parameter const* parameter = package.findParameter(name);
    if (!parameter) return unknownParameter(*instance.material, name);
    if (Result<void> fits = checkTexture(*instance.material, *parameter, texture); !fits) return fits;
    TextureHandle shown = textureHandle(texture);
    if (!shown) shown = textureHandle(unsetTexture(*parameter));
    markDirty(handle);
    instance.textures[textureSlot(package, *parameter)] = { shown, sampler };
    instance.texturesDirty = true;
    return {};
}

Result<Material> Engine::create(MaterialDesc const& desc) {
    return orOutOfMemory("material", desc.name, [&] { return mImpl->createMaterial(desc); });
}

MaterialInstance Engine::createInstance(Material material, std::string name) {
    return mImpl->orNone("material instance", {}, [&] { return mImpl->createInstance(material, std::move(name)); });
}

Result<void> Engine::set(MaterialInstance instance, std::string_view parameter, ParameterValue const& value) {
    return orOutOfMemory("parameter", parameter, [&] { return mImpl->set(instance, parameter, value); });
}

Result<void> Engine::set(MaterialInstance instance, std::string_view parameter, ParameterArray const& values,
                         uint32_t first) {
    return orOutOfMemory("parameter", parameter, [&] { return mImpl->set(instance, parameter, values, first); });
}

Result<void> Engine::set(MaterialInstance instance, std::string_view parameter, Texture texture, Sampler sampler) {
    return orOutOfMemory("parameter", parameter, [&] { return mImpl->set(instance, parameter, texture, sampler); });
}

MaterialDescription const& Engine::describe(Material material) const {
    return mImpl->materials.get(material).description;
}

Result<void> Engine::setDoubleSided(MaterialInstance handle, bool doubleSided) {
    scene::MaterialInstance& instance = mImpl->instances.get(handle);
    shader::MaterialPackage const& package = instance.material->package;
    Parameter const* parameter = package.findParameter(shader::kDoubleSidedParameter);
    if (!parameter && !package.doubleSided) {
        return fail(ErrorCode::InvalidArgument,
                    "material '{}' was compiled for one side: say doubleSided : true or doubleSided : false in it, and "
                    "its instances can choose",
                    instance.material->name);
    }
    if (parameter) {
        if (Result<void> done = set(handle, parameter->name, ParameterValue(doubleSided)); !done) return done;
    }
    instance.raster.cullingDisabled = doubleSided;
    return {};
}

Result<void> Engine::setMaskThreshold(MaterialInstance handle, float threshold) {
    scene::Material const& material = *mImpl->instances.get(handle).material;
    if (!material.package.findParameter(shader::kMaskThresholdParameter)) {
        return fail(ErrorCode::InvalidArgument, "material '{}' has no mask threshold: only blending : masked cuts out",
                    material.name);
    }
    if (!(threshold >= 0 && threshold <= 1)) {
        return fail(ErrorCode::InvalidArgument, "material '{}': a mask threshold lies in [0, 1], and {} does not",
                    material.name, threshold);
    }
    return set(handle, shader::kMaskThresholdParameter, ParameterValue(threshold));
}

void Engine::setCullingDisabled(MaterialInstance handle, bool disabled) {
    mImpl->instances.get(handle).raster.cullingDisabled = disabled;
}

void Engine::setCulling(MaterialInstance handle, Culling culling) {
    scene::RasterState& raster = mImpl->instances.get(handle).raster;
    raster.culling = culling;
    raster.cullingDisabled = false;
}

void Engine::setColorWrite(MaterialInstance handle, bool writes) {
    mImpl->instances.get(handle).raster.colorWrite = writes;
}

void Engine::setDepthWrite(MaterialInstance handle, bool writes) {
    mImpl->instances.get(handle).raster.depthWrite = writes;
}

void Engine::setDepthCulling(MaterialInstance handle, bool tests) {
    mImpl->instances.get(handle).raster.depthCulling = tests;
}

void Engine::Impl::updateInstance(scene::MaterialInstance& instance, CommandBuffer& commands) {
    shader::MaterialPackage const& package = instance.material->package;
    if (package.uniformBytes > 0 && !instance.buffer) {
        NewHandle buffer(*stream, stream->allocateBuffer());
        commands.record(CmdCreateBuffer{ buffer, { package.uniformBytes, BufferUsage::Uniform, instance.name } });
        instance.buffer = buffer.keep();
    }
    if (package.uniformBytes > 0 && instance.parametersDirty) {
        commands.record(CmdUpdateBuffer{ instance.buffer, 0, instance.parameters });
    }
    if (instance.texturesDirty) {
        if (instance.group) stream->destroy(commands, std::exchange(instance.group, {}));
        std::array<BindGroupEntry, kMaxBindings> entries{};
        uint32_t count = 0;
        if (package.uniformBytes > 0) {
            entries[count++] = { .binding = 0, .buffer = instance.buffer, .size = package.uniformBytes };
        }
        size_t slot = 0;
        for (Parameter const& parameter : package.parameters) {
            if (!shader::isTexture(parameter.type)) continue;
            const scene::TextureBinding bound = instance.textures[slot++];
            const bool isFloat = parameter.format == shader::SamplerFormat::Float;
            const Sampler sampler = isFloat ? filtered(bound.sampler, textureFilter) : unfiltered(bound.sampler);
            entries[count++] = { .binding = parameter.binding,
                                 .texture = bound.texture,
                                 .sampler = samplers.get(sampler, commands) };
        }
        NewHandle group(*stream, stream->allocateBindGroup());
        commands.record(CmdCreateBindGroup{
                group, { package.layout[shader::kGroupMaterial], std::span(entries).first(count), instance.name } });
        instance.group = group.keep();
    }
    instance.parametersDirty = instance.texturesDirty = false;
}

void Engine::destroy(Material material) {
    scene::Material& state = mImpl->materials.get(material);
    FILAMENT_ASSERT(state.instanceCount == 0, "the instances of a material are destroyed before it");
    mImpl->compilations.forget(state);
    mImpl->pipelines.forget(mImpl->pending, state);
    mImpl->materials.remove(material);
}

void Engine::destroy(MaterialInstance handle) {
    scene::MaterialInstance& instance = mImpl->instances.get(handle);
    std::erase(mImpl->dirtyInstances, handle);
    if (instance.group) mImpl->stream->destroy(mImpl->pending, instance.group);
    if (instance.buffer) mImpl->stream->destroy(mImpl->pending, instance.buffer);
    --instance.material->instanceCount;
    mImpl->instances.remove(handle);
}

} // namespace filament
