// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/MaterialStand.h"

#include "base/Suggest.h"
#include "shaders/package/EngineMaterials.h"
#include "toolkit/materials/MaterialMeshes.h"
#include "toolkit/materials/MaterialValues.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cstddef>

namespace filament_core::tools {
namespace {

std::vector<AttributeDesc> attributes() {
    std::vector<AttributeDesc> list{
        { Attribute::Position, VertexFormat::Float3, offsetof(MaterialVertex, position) },
        { Attribute::Tangents, VertexFormat::Float4, offsetof(MaterialVertex, tangents) },
        { Attribute::Color, VertexFormat::Float4, offsetof(MaterialVertex, color) },
        { Attribute::Uv0, VertexFormat::Float2, offsetof(MaterialVertex, uv0) },
        { Attribute::Uv1, VertexFormat::Float2, offsetof(MaterialVertex, uv1) },
    };
    for (uint32_t i = 0; i < 8; ++i) {
        list.push_back({ static_cast<Attribute>(static_cast<uint32_t>(Attribute::Custom0) + i), VertexFormat::Float4,
                         static_cast<uint32_t>(offsetof(MaterialVertex, custom) + i * sizeof(float4)) });
    }
    return list;
}

Error unknownValue(MaterialFile const& file, std::string const& name) {
    std::vector<std::string_view> known;
    for (auto const& parameter : file.package.parameters) known.push_back(parameter.name);
    for (auto const& constant : file.package.constants) known.push_back(constant.name);
    return fail(ErrorCode::NotFound, "material '{}' has no parameter or constant '{}'{}", file.name, name,
                suggestion(name, known));
}

/// A block that passes through the object from left to right.
double4x4 slabPlace() {
    return glm::scale(glm::rotate(double4x4(1.0), 0.35, double3(0, 0, 1)), double3(2.0, 0.22, 0.9));
}

/// In [-1, 1] of x.
double4x4 placeInRow(uint32_t index, uint32_t count) {
    const double size = 1.0 / count;
    return glm::scale(glm::translate(double4x4(1.0), double3((2.0 * index + 1) * size - 1, 0, 0)), double3(size));
}

} // namespace

Result<MaterialStand::Geometry> MaterialStand::makeGeometry(Engine& engine, std::string const& name) {
    const std::optional<MaterialMesh> mesh = makeMaterialMesh(name);
    if (!mesh) {
        return fail(ErrorCode::NotFound,
                    "there is no mesh '{}': sphere, plane, box, torus, scroll, lines, screen or billboard", name);
    }
    return Geometry{
        engine.own(engine.create(VertexBufferDesc{ .vertexCount = static_cast<uint32_t>(mesh->vertices.size()),
                                                   .stride = sizeof(MaterialVertex),
                                                   .attributes = attributes(),
                                                   .data = std::as_bytes(std::span(mesh->vertices)),
                                                   .name = name })),
        engine.own(engine.create(IndexBufferDesc{ .indexCount = static_cast<uint32_t>(mesh->indices.size()),
                                                  .data = std::as_bytes(std::span(mesh->indices)),
                                                  .name = name }))
    };
}

Result<void> MaterialStand::addSlab(Engine& engine) {
    if (!mSlabMaterial.get()) {
        Result<Material> material = engine.create(MaterialDesc{ .package = shader::engineMaterial(kSlabPackage) });
        if (!material) return material.error();
        mSlabMaterial = engine.own(*material);
    }
    mSlabInstance = engine.own(engine.createInstance(mSlabMaterial, "slab"));
    if (Result<void> done = engine.set(mSlabInstance, "baseColorFactor", float4(0.5f, 0.5f, 0.5f, 1)); !done)
        return done;
    if (Result<void> done = engine.set(mSlabInstance, "roughnessFactor", 0.6f); !done) return done;
    Result<Geometry> box = makeGeometry(engine, "box");
    if (!box) return box.error();
    mBox = std::move(*box);
    return {};
}

Result<void> MaterialStand::set(Engine& engine, MaterialFile const& file, MaterialValues const& values) {
    return setAll(engine, mInstance, file, values);
}

Result<MaterialInstance> MaterialStand::vary(Engine& engine, MaterialFile const& file, MaterialValues const& values) {
    Owned<MaterialInstance> instance = engine.own(engine.createInstance(mMaterial, file.name));
    if (Result<void> done = setAll(engine, instance, file, values); !done) return done.error();
    mVariations.push_back(std::move(instance));
    return mVariations.back().get();
}

Result<void> MaterialStand::setAll(Engine& engine, MaterialInstance instance, MaterialFile const& file,
                                   MaterialValues const& values) {
    for (auto const& [name, value] : values) {
        if (Result<void> done = setOne(engine, instance, file, name, value); !done) return done;
    }
    return {};
}

Result<void> MaterialStand::setOne(Engine& engine, MaterialInstance instance, MaterialFile const& file,
                                   std::string const& name, std::string const& value) {
    shader::Parameter const* parameter = file.package.findParameter(name);
    if (!parameter) {
        if (file.package.findConstant(name)) return {}; // set when the material was created
        return unknownValue(file, name);
    }
    if (!shader::isTexture(parameter->type)) return setMaterialValue(engine, instance, *parameter, value);
    Result<MaterialPicture> picture = makeMaterialPicture(engine, value);
    if (!picture) return picture.error();
    mPictures.push_back(std::move(*picture));
    return engine.set(instance, name, mPictures.back().texture, mPictures.back().sampler);
}

Result<MaterialStand> MaterialStand::make(Engine& engine, MaterialFile const& file, MaterialValues const& values,
                                          std::string const& meshName, StandMaterials made) {
    MaterialValues all = file.show.values;
    for (auto const& value : values) {
        std::erase_if(all, [&](auto const& old) { return old.first == value.first; });
        all.push_back(value);
    }
    if (!made.shown.get()) {
        Result<std::vector<MaterialConstant>> constants = materialConstants(file.package, all);
        if (!constants) return constants.error();
        Result<Material> material =
                engine.create(MaterialDesc{ .package = file.bytes, .constants = *constants, .name = file.name });
        if (!material) return material.error();
        made.shown = engine.own(*material);
    }
    MaterialStand stand;
    stand.mName = file.name;
    stand.mMaterial = std::move(made.shown);
    stand.mSlabMaterial = std::move(made.slab);
    stand.mInstance = engine.own(engine.createInstance(stand.mMaterial, file.name));
    stand.mInstances = file.show.instances;
    stand.mIsInObjectSpace = file.package.vertexDomain == shader::VertexDomain::Object;
    Result<Geometry> mesh = makeGeometry(engine, meshName.empty() ? file.show.mesh : meshName);
    if (!mesh) return mesh.error();
    stand.mMesh = std::move(*mesh);
    if (file.show.slab) {
        if (Result<void> done = stand.addSlab(engine); !done) return done.error();
    }
    if (Result<void> done = stand.set(engine, file, all); !done) return done.error();
    return stand;
}

Node MaterialStand::addTo(Scene& scene, double4x4 const& worldFromObject, LightChannels channels,
                          MaterialInstance instance) const {
    std::vector<double4x4> places;
    for (uint32_t i = 0; i < mInstances; ++i) places.push_back(placeInRow(i, mInstances));
    const Node root = scene.addInstances({ .vertices = mMesh.vertices,
                                           .indices = mMesh.indices,
                                           .material = instance ? instance : mInstance.get(),
                                           .bounds = Box{ double3(-1), double3(1) },
                                           .worldFromObject = worldFromObject,
                                           .culled = mIsInObjectSpace,
                                           .lightChannels = channels,
                                           .name = mName },
                                         mInstances, places);
    if (!mSlabMaterial.get()) return root;
    scene.add({ .vertices = mBox.vertices,
                .indices = mBox.indices,
                .material = mSlabInstance,
                .bounds = Box{ double3(-0.7f), double3(0.7f) },
                .node = scene.add(NodeDesc{ .parent = root, .parentFromNode = slabPlace() }),
                .lightChannels = channels,
                .name = "slab" });
    return root;
}

} // namespace filament_core::tools
