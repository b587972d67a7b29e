// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/Loaded.h"

#include "base/Suggest.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/materials/LoadMaterial.h"
#include "shaders/package/EngineMaterials.h"
#include "shaders/package/ParameterLayout.h"
#include "toolkit/materials/PictureFile.h"

#include <cstring>

namespace filament_core::view {
namespace {

template <class T>
void readValue(std::byte const* from, T& value) {
    std::memcpy(&value, from, sizeof(value));
}
void readValue(std::byte const* from, bool& value) {
    uint32_t word = 0;
    std::memcpy(&word, from, sizeof(word));
    value = word != 0;
}
template <int N>
void readValue(std::byte const* from, glm::vec<N, bool>& value) {
    for (int i = 0; i < N; ++i) readValue(from + 4 * i, value[i]);
}
void readValue(std::byte const* from, float3x3& value) {
    for (int column = 0; column < 3; ++column) readValue(from + 16 * column, value[column]);
}

/// A value of the type at this place among the alternatives.
template <size_t... I>
ParameterValue valueOfType(size_t index, std::index_sequence<I...>) {
    ParameterValue value;
    ((I == index ? static_cast<void>(value.emplace<I>()) : static_cast<void>(0)), ...);
    return value;
}

LoadState stateOf(LoadStatus const& status) {
    return {
        .step = toString(status.stage), .done = status.done, .total = status.total, .isFinished = status.isFinished()
    };
}

/// On a thread of its own: compiles and unpacks.
Result<ReadMaterial> readMaterial(std::filesystem::path const& path) {
    Result<tools::MaterialFile> file = tools::compileMaterialFile(path);
    if (!file) return file.error();
    Result<std::vector<MaterialConstant>> constants = tools::materialConstants(file->package, file->show.values);
    if (!constants) return constants.error();
    Result<scene::Material> shown = engine::loadMaterial({ file->bytes, std::move(*constants), file->name });
    if (!shown) return shown.error();
    ReadMaterial read{ std::move(*file), std::move(*shown), {} };
    if (!read.file.show.slab) return read;
    Result<scene::Material> slab =
            engine::loadMaterial({ shader::engineMaterial(tools::MaterialStand::kSlabPackage), {}, {} });
    if (!slab) return slab.error();
    read.slab = std::move(*slab);
    return read;
}

Result<Owned<Material>> addTo(Engine& engine, scene::Material material) {
    const Result<Material> added = engine.impl().addMaterial(std::move(material));
    if (!added) return added.error();
    return engine.own(*added);
}

Result<LoadedMaterial> onStand(Engine& engine, ReadMaterial read) {
    tools::StandMaterials materials;
    Result<Owned<Material>> shown = addTo(engine, std::move(read.shown));
    if (!shown) return shown.error();
    materials.shown = std::move(*shown);
    if (read.slab) {
        Result<Owned<Material>> slab = addTo(engine, std::move(*read.slab));
        if (!slab) return slab.error();
        materials.slab = std::move(*slab);
    }
    auto shared = std::make_shared<const tools::MaterialFile>(std::move(read.file));
    Result<tools::MaterialStand> stand = tools::MaterialStand::make(engine, *shared, {}, {}, std::move(materials));
    if (!stand) return stand.error();
    LoadedMaterial loaded{ .file = shared, .stand = std::move(*stand), .values = {}, .textures = {} };
    for (shader::Parameter const& parameter : shared->package.parameters) {
        Result<ParameterValue> value = parameterOf(engine, loaded.stand.instance(), parameter.name);
        if (value) loaded.values.emplace_back(parameter.name, std::move(*value));
    }
    loaded.textures = texturesOf(engine, loaded.stand.instance());
    return loaded;
}

} // namespace

Result<ParameterValue> parameterOf(Engine& engine, MaterialInstance instance, std::string_view name) {
    scene::MaterialInstance const& record = engine.impl().instances.get(instance);
    shader::MaterialPackage const& package = record.material->package;
    shader::Parameter const* parameter = package.findParameter(name);
    if (!parameter)
        return fail(ErrorCode::NotFound, "material '{}' has no parameter '{}'{}", record.material->name, name,
                    suggestion(name, namesOf(package.parameters)));
    if (shader::isTexture(parameter->type) || parameter->arraySize > 0)
        return fail(ErrorCode::Unsupported, "parameter '{}' of material '{}' is a texture or an array", name,
                    record.material->name);
    constexpr auto kTypes = std::make_index_sequence<std::variant_size_v<ParameterValue>>();
    ParameterValue value = valueOfType(static_cast<size_t>(parameter->type), kTypes);
    std::visit([&](auto& held) { readValue(record.parameters.data() + parameter->offset, held); }, value);
    return value;
}

std::vector<scene::TextureBinding> texturesOf(Engine& engine, MaterialInstance instance) {
    return engine.impl().instances.get(instance).textures;
}

void setTextures(Engine& engine, MaterialInstance instance, std::vector<scene::TextureBinding> const& textures) {
    scene::MaterialInstance& record = engine.impl().instances.get(instance);
    engine.impl().markDirty(instance);
    record.textures = textures;
    record.texturesDirty = engine.impl().aUseEnded = true;
}

Box LoadedModel::bounds() const {
    if (Model const* gltf = model()) return gltf->bounds();
    return material() ? Box{ double3(-1), double3(1) } : Box{};
}

// ---- ModelLoad

ModelLoad::ModelLoad(Engine& engine, DocumentModel const& model)
        : mFile(model.file),
          mWork(tools::isMaterialFile(model.file)
                        ? decltype(mWork)(Compile([file = model.file] { return readMaterial(file); }))
                        : decltype(mWork)(loadGltfAsync(engine, model.file, model.options))) {}

LoadState ModelLoad::poll(size_t sliceBytes) {
    if (auto* ticket = std::get_if<LoadTicket<Model>>(&mWork)) return stateOf(ticket->poll(sliceBytes));
    return state();
}

LoadState ModelLoad::state() const {
    if (auto const* ticket = std::get_if<LoadTicket<Model>>(&mWork)) return stateOf(ticket->status());
    return { .step = "compiling", .isFinished = std::get<Compile>(mWork).isFinished() };
}

Result<LoadedModel> ModelLoad::take(Engine& engine) {
    if (auto* ticket = std::get_if<LoadTicket<Model>>(&mWork)) {
        Result<Model> model = ticket->take();
        if (!model) return model.error();
        return LoadedModel{ .file = mFile, .content = std::move(*model) };
    }
    Result<ReadMaterial> read = std::get<Compile>(mWork).take();
    if (!read) return read.error();
    Result<LoadedMaterial> material = onStand(engine, std::move(*read));
    if (!material) return material.error();
    return LoadedModel{ .file = mFile, .content = std::move(*material) };
}

void ModelLoad::abandon(Abandoned& abandoned) {
    if (auto const* compile = std::get_if<Compile>(&mWork)) abandoned.add(*compile); // a ticket ends by itself
}

// ---- the others

EnvironmentLoad::EnvironmentLoad(Engine& engine, DocumentEnvironment const& environment)
        : mTicket(loadEnvironmentAsync(engine, environment.file, environment.options)) {}

LoadState EnvironmentLoad::poll(size_t sliceBytes) { return stateOf(mTicket.poll(sliceBytes)); }
LoadState EnvironmentLoad::state() const { return stateOf(mTicket.status()); }

LookLoad::LookLoad(Engine&, std::filesystem::path const& file) : mWork([file] { return loadLook(file); }) {}

DirtLoad::DirtLoad(Engine&, std::filesystem::path const& file)
        : mFile(file), mWork([file] { return tools::readPictureFile(file); }) {}

Result<Owned<Texture>> DirtLoad::take(Engine& engine) {
    const Result<assets::Image> picture = mWork.take();
    if (!picture) return picture.error();
    return tools::makePictureTexture(engine, *picture, mFile);
}

} // namespace filament_core::view
