// SPDX-License-Identifier: Apache-2.0
// Materials and their instances: packages -> programs, named parameters -> uniform blocks and bind groups.
#include "filament_core/base/OutOfMemory.h"
#include "filament_core/base/Result.h"
#include "filament_core/base/Suggest.h"
#include "filament_core/engine/EngineImpl.h"
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
            return fail(ErrorCode::InvalidArgument, "constant '{}' of material '{}' was given a value of another type",
                        constant.name, package.name);
        }
        values.push_back({ known->id, bitsOf(constant.value), known->type });
    }
    return values;
}

// What a ParameterValue may be assigned to, and its bytes without std140 padding.
struct RawValue {
    ParameterType type;
    uint32_t columns; ///< 1, or the columns of a matrix: each starts at a multiple of 16 bytes
    uint32_t columnBytes;
    const void* data;
};

RawValue rawValue(ParameterValue const& value, uint32_t& boolStorage) {
    struct Visitor {
        uint32_t& boolBits;
        RawValue operator()(bool v) const {
            boolBits = v;
            return { ParameterType::Bool, 1, 4, &boolBits };
        }
        RawValue operator()(int32_t const& v) const { return { ParameterType::Int, 1, 4, &v }; }
        RawValue operator()(uint32_t const& v) const { return { ParameterType::Uint, 1, 4, &v }; }
        RawValue operator()(float const& v) const { return { ParameterType::Float, 1, 4, &v }; }
        RawValue operator()(float2 const& v) const { return { ParameterType::Float2, 1, 8, &v }; }
        RawValue operator()(float3 const& v) const { return { ParameterType::Float3, 1, 12, &v }; }
        RawValue operator()(float4 const& v) const { return { ParameterType::Float4, 1, 16, &v }; }
        RawValue operator()(float3x3 const& v) const { return { ParameterType::Float3x3, 3, 12, &v }; }
        RawValue operator()(float4x4 const& v) const { return { ParameterType::Float4x4, 4, 16, &v }; }
    };
    return std::visit(Visitor{ boolStorage }, value);
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
    return material;
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
    instance.cullingDisabled = parent.package.doubleSided;
    if (Parameter const* threshold = parent.package.findParameter("_maskThreshold")) {
        std::memcpy(instance.parameters.data() + threshold->offset, &parent.package.maskThreshold, sizeof(float));
    }
    const scene::TextureBinding white{ textureHandle(defaults.white), {} };
    for (Parameter const& parameter : parent.package.parameters) {
        if (shader::isTexture(parameter.type)) instance.textures.push_back(white);
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

Result<void> Engine::Impl::set(MaterialInstance handle, std::string_view name, ParameterValue const& value) {
    scene::MaterialInstance& instance = instances.get(handle);
    Parameter const* parameter = instance.material->package.findParameter(name);
    if (!parameter) return unknownParameter(*instance.material, name);
    uint32_t boolStorage = 0;
    const RawValue raw = rawValue(value, boolStorage);
    if (raw.type != parameter->type) {
        return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' was given a value of another type",
                    name, instance.material->name);
    }
    markDirty(handle);
    for (uint32_t column = 0; column < raw.columns; ++column) {
        std::memcpy(instance.parameters.data() + parameter->offset + column * 16,
                    static_cast<const std::byte*>(raw.data) + column * raw.columnBytes, raw.columnBytes);
    }
    instance.parametersDirty = true;
    return {};
}

Result<void> Engine::Impl::set(MaterialInstance handle, std::string_view name, Texture texture, Sampler sampler) {
    scene::MaterialInstance& instance = instances.get(handle);
    shader::MaterialPackage const& package = instance.material->package;
    Parameter const* parameter = package.findParameter(name);
    if (!parameter) return unknownParameter(*instance.material, name);
    if (!shader::isTexture(parameter->type)) {
        return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is not a sampler", name,
                    instance.material->name);
    }
    const Texture standIn = parameter->type == ParameterType::SamplerCube ? defaults.blackCube : defaults.white;
    const TextureHandle handleOrNone = textureHandle(texture);
    markDirty(handle);
    instance.textures[textureSlot(package, *parameter)] = { handleOrNone ? handleOrNone : textureHandle(standIn),
                                                            sampler };
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

Result<void> Engine::set(MaterialInstance instance, std::string_view parameter, Texture texture, Sampler sampler) {
    return orOutOfMemory("parameter", parameter, [&] { return mImpl->set(instance, parameter, texture, sampler); });
}

void Engine::setCullingDisabled(MaterialInstance handle, bool disabled) {
    mImpl->instances.get(handle).cullingDisabled = disabled;
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
            entries[count++] = { .binding = parameter.binding,
                                 .texture = bound.texture,
                                 .sampler = samplers.get(filtered(bound.sampler, textureFilter), commands) };
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
