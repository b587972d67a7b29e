// SPDX-License-Identifier: Apache-2.0
// Instances of materials: named parameters -> uniform blocks and bind groups, and overrides of the raster state.
#include "base/OutOfMemory.h"
#include "base/Result.h"
#include "base/Suggest.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/materials/Parameters.h"
#include "filament_core/engine/materials/TextureParameters.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace filament_core {

using engine::PublicCall;

namespace {

using namespace backend;
using shader::Parameter;

Error unknownParameter(scene::Material const& material, std::string_view name) {
    return fail(ErrorCode::NotFound, "material '{}' has no parameter '{}'{}", material.name, name,
                suggestion(name, namesOf(material.package.parameters)));
}

Result<Parameter const*> parameterOf(scene::Material const& material, ParameterKey const& key) {
    std::vector<Parameter> const& all = material.package.parameters;
    if (const std::optional<ParameterId> id = key.id()) {
        FILAMENT_ASSERT(id->material == material.id && id->index < all.size(),
                        "a ParameterId belongs to the material of the instance");
        return &all[id->index];
    }
    if (Parameter const* found = material.package.findParameter(key.name())) return found;
    return unknownParameter(material, key.name());
}

} // namespace

void Engine::Impl::useTextureFilter(TextureFilter filter) {
    bool& isInUse = filtersInUse[static_cast<size_t>(filter)];
    if (isInUse) return;
    instances.forEachHeld([&](MaterialInstance handle, scene::MaterialInstance& instance) {
        if (instance.textures.empty()) return;
        markDirty(handle);
        instance.lacksGroups = true;
    });
    // Last: if memory runs out on the way, the next frame marks the rest.
    isInUse = true;
}

MaterialInstance Engine::Impl::createInstance(Material material, std::string name) {
    scene::Material& parent = materials.get(material);
    engine::Draft draft(instances);
    scene::MaterialInstance& instance = draft.state();
    instance.material = &parent;
    instance.name = name.empty() ? parent.name : std::move(name);
    instance.parameters = parent.initialParameters;
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
            instance.textures.push_back({ textureHandle(unsetTexture(parameter)), kUnfilteredSampler });
    }
    dirtyInstances.push_back(draft.handle()); // the last call that can fail
    instance.id = nextInstanceId++;
    ++parent.instanceCount;
    return draft.keep();
}

void Engine::Impl::markDirty(MaterialInstance handle) {
    ++instanceChanges;
    scene::MaterialInstance const& instance = instances.held(handle);
    if (!instance.isDirty()) dirtyInstances.push_back(handle);
}

template <class Write>
void Engine::Impl::changeRaster(MaterialInstance handle, Write&& write) {
    write(instances.get(handle).raster);
    ++rasterChanges;
    ++instanceChanges;
}

template <class Write>
Result<void> Engine::Impl::change(MaterialInstance handle, ParameterKey const& key, Write&& write) {
    scene::MaterialInstance& instance = instances.get(handle);
    const Result<Parameter const*> parameter = parameterOf(*instance.material, key);
    if (!parameter) return parameter.error();
    const size_t listed = dirtyInstances.size();
    markDirty(handle);
    Result<void> written = write(instance, **parameter);
    if (written)
        instance.parametersDirty = true;
    else
        dirtyInstances.resize(listed); // only shrinks: markDirty() added one at most
    return written;
}

Result<void> Engine::Impl::set(MaterialInstance handle, ParameterKey const& key, ParameterValue const& value) {
    return change(handle, key, [&](scene::MaterialInstance& instance, Parameter const& parameter) {
        return engine::writeParameter(*instance.material, parameter, value, instance.parameters);
    });
}

Result<void> Engine::Impl::set(MaterialInstance handle, ParameterKey const& key, ParameterArray const& values,
                               uint32_t first) {
    return change(handle, key, [&](scene::MaterialInstance& instance, Parameter const& parameter) {
        return engine::writeParameters(*instance.material, parameter, values, first, instance.parameters);
    });
}

Result<void> Engine::Impl::set(MaterialInstance handle, ParameterKey const& key, Texture texture, Sampler sampler) {
    scene::MaterialInstance& instance = instances.get(handle);
    const Result<Parameter const*> found = parameterOf(*instance.material, key);
    if (!found) return found.error();
    Parameter const* parameter = *found;
    if (Result<void> isSampler = engine::checkSampler(*instance.material, *parameter); !isSampler) return isSampler;
    engine::TextureState const& given = textures.get(texture);
    if (Result<void> fits = engine::checkTexture(*instance.material, *parameter, given.desc, given.name); !fits)
        return fits;
    TextureHandle shown = textureHandle(texture);
    if (!shown) shown = textureHandle(unsetTexture(*parameter));
    markDirty(handle);
    instance.textures[engine::textureSlot(instance.material->package, *parameter)] = { shown, sampler };
    instance.texturesDirty = aUseEnded = true;
    return {};
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
    // Groups are immutable: another texture needs another group.
    if (instance.texturesDirty) destroyGroups(instance, commands);
    makeGroups(instance, commands);
    instance.parametersDirty = instance.texturesDirty = instance.lacksGroups = false;
}

// Existing groups are kept.
void Engine::Impl::makeGroups(scene::MaterialInstance& instance, CommandBuffer& commands) {
    if (instance.textures.empty()) {
        if (!instance.groups[0]) instance.groups.fill(makeGroup(instance, TextureFilter::AsAuthored, commands));
        return;
    }
    for (size_t filter = 0; filter < filtersInUse.size(); ++filter) {
        if (filtersInUse[filter] && !instance.groups[filter])
            instance.groups[filter] = makeGroup(instance, static_cast<TextureFilter>(filter), commands);
    }
}

BindGroupHandle Engine::Impl::makeGroup(scene::MaterialInstance const& instance, TextureFilter filter,
                                        CommandBuffer& commands) {
    shader::MaterialPackage const& package = instance.material->package;
    std::array<BindGroupEntry, kMaxBindings> entries{};
    uint32_t count = 0;
    if (package.uniformBytes > 0)
        entries[count++] = { .binding = 0, .buffer = instance.buffer, .size = package.uniformBytes };
    size_t slot = 0;
    for (Parameter const& parameter : package.parameters) {
        if (!shader::isTexture(parameter.type)) continue;
        const scene::TextureBinding bound = instance.textures[slot++];
        if (!parameter.isBound) continue; // the constants that use it are false
        const SamplerDesc sampler = engine::descOf(engine::samplerFor(parameter, bound.sampler, filter));
        entries[count++] = { .binding = parameter.binding,
                             .texture = bound.texture,
                             .sampler = samplers.get(sampler, commands) };
    }
    NewHandle group(*stream, stream->allocateBindGroup());
    commands.record(CmdCreateBindGroup{
            group, { package.layout[shader::kGroupMaterial], std::span(entries).first(count), instance.name } });
    return group.keep();
}

void Engine::Impl::destroyGroups(scene::MaterialInstance& instance, CommandBuffer& commands) {
    if (instance.textures.empty()) std::fill(instance.groups.begin() + 1, instance.groups.end(), BindGroupHandle{});
    for (BindGroupHandle& group : instance.groups) {
        if (group) stream->destroy(commands, std::exchange(group, {}));
    }
}

MaterialInstance Engine::createInstance(Material material, std::string name) {
    const PublicCall call(mImpl, "Engine::createInstance(Material, string)");
    return mImpl->orNone("material instance", {}, [&] { return mImpl->createInstance(material, std::move(name)); });
}

Result<ParameterId> Engine::findParameter(Material material, std::string_view name) const {
    const PublicCall call(mImpl, "Engine::findParameter(Material, string_view)", name);
    return orOutOfMemory("parameter", name, [&]() -> Result<ParameterId> {
        scene::Material const& of = mImpl->materials.get(material);
        const Result<Parameter const*> found = parameterOf(of, name);
        if (!found) return found.error();
        return ParameterId{ of.id, static_cast<uint32_t>(*found - of.package.parameters.data()) };
    });
}

Result<void> Engine::set(MaterialInstance instance, ParameterKey const& parameter, ParameterValue const& value) {
    const PublicCall call(mImpl, "Engine::set(MaterialInstance, ParameterKey, ParameterValue)", parameter.name());
    return orOutOfMemory("parameter", parameter.name(), [&] { return mImpl->set(instance, parameter, value); });
}

Result<void> Engine::set(MaterialInstance instance, ParameterKey const& parameter, ParameterArray const& values,
                         uint32_t first) {
    const PublicCall call(mImpl, "Engine::set(MaterialInstance, ParameterKey, ParameterArray, uint32_t)",
                          parameter.name());
    return orOutOfMemory("parameter", parameter.name(), [&] { return mImpl->set(instance, parameter, values, first); });
}

Result<void> Engine::set(MaterialInstance instance, ParameterKey const& parameter, Texture texture, Sampler sampler) {
    const PublicCall call(mImpl, "Engine::set(MaterialInstance, ParameterKey, Texture, Sampler)", parameter.name());
    return orOutOfMemory("parameter", parameter.name(),
                         [&] { return mImpl->set(instance, parameter, texture, sampler); });
}

Result<void> Engine::setNumber(MaterialInstance instance, ParameterKey const& parameter,
                               ParameterNumber const& number) {
    const PublicCall call(mImpl, "Engine::set(MaterialInstance, ParameterKey, ParameterValue)", parameter.name());
    return orOutOfMemory("parameter", parameter.name(), [&] {
        return mImpl->change(instance, parameter, [&](scene::MaterialInstance& state, Parameter const& known) {
            return engine::writeNumber(*state.material, known, number, state.parameters);
        });
    });
}

Result<void> Engine::setDoubleSided(MaterialInstance handle, bool doubleSided) {
    const PublicCall call(mImpl, "Engine::setDoubleSided(MaterialInstance, bool)");
    scene::MaterialInstance& instance = mImpl->instances.get(handle);
    shader::MaterialPackage const& package = instance.material->package;
    Parameter const* parameter = package.findParameter(shader::kDoubleSidedParameter);
    if (!parameter && !package.doubleSided) {
        return fail(
                ErrorCode::InvalidArgument,
                "material '{}' was compiled for one side; set doubleSided : true or doubleSided : false in it, so that "
                "its instances can choose",
                instance.material->name);
    }
    if (parameter) {
        if (Result<void> done = set(handle, parameter->name, ParameterValue(doubleSided)); !done) return done;
    }
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) { raster.cullingDisabled = doubleSided; });
    return {};
}

Result<void> Engine::setMaskThreshold(MaterialInstance handle, float threshold) {
    const PublicCall call(mImpl, "Engine::setMaskThreshold(MaterialInstance, float)");
    scene::Material const& material = *mImpl->instances.get(handle).material;
    if (!material.package.findParameter(shader::kMaskThresholdParameter)) {
        return fail(ErrorCode::InvalidArgument, "material '{}' has no mask threshold: only blending : masked cuts out",
                    material.name);
    }
    if (!(threshold >= 0 && threshold <= 1)) {
        return fail(ErrorCode::InvalidArgument, "material '{}': a mask threshold must be in [0, 1], but is {}",
                    material.name, threshold);
    }
    return set(handle, shader::kMaskThresholdParameter, ParameterValue(threshold));
}

void Engine::setCullingDisabled(MaterialInstance handle, bool disabled) {
    const PublicCall call(mImpl, "Engine::setCullingDisabled(MaterialInstance, bool)");
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) { raster.cullingDisabled = disabled; });
}

void Engine::setCulling(MaterialInstance handle, Culling culling) {
    const PublicCall call(mImpl, "Engine::setCulling(MaterialInstance, Culling)");
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) {
        raster.culling = culling;
        raster.cullingDisabled = false;
    });
}

void Engine::setShadowCulling(MaterialInstance handle, std::optional<Culling> culling) {
    const PublicCall call(mImpl, "Engine::setShadowCulling(MaterialInstance, optional<Culling>)");
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) { raster.shadowCulling = culling; });
}

void Engine::setColorWrite(MaterialInstance handle, bool writes) {
    const PublicCall call(mImpl, "Engine::setColorWrite(MaterialInstance, bool)");
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) { raster.colorWrite = writes; });
}

void Engine::setDepthWrite(MaterialInstance handle, bool writes) {
    const PublicCall call(mImpl, "Engine::setDepthWrite(MaterialInstance, bool)");
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) { raster.depthWrite = writes; });
}

void Engine::setDepthCulling(MaterialInstance handle, bool tests) {
    const PublicCall call(mImpl, "Engine::setDepthCulling(MaterialInstance, bool)");
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) { raster.depthCulling = tests; });
}

void Engine::setStencil(MaterialInstance handle, std::optional<StencilState> state) {
    const PublicCall call(mImpl, "Engine::setStencil(MaterialInstance, optional<StencilState>)");
    mImpl->changeRaster(handle, [&](scene::InstanceRaster& raster) { raster.stencil = state; });
}

} // namespace filament_core
