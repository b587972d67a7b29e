// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/ModelParts.h"

#include "base/Assert.h"
#include "base/Log.h"
#include "filament_core/engine/gltf/CopiesOfModels.h"
#include "filament_core/engine/gltf/GltfMaterialSettings.h"
#include "filament_core/scene/SceneNodes.h"

#include <algorithm>
#include <array>

namespace filament::engine {
namespace {

using assets::AnimatedProperty;
using assets::kNone;
using assets::MapName;
using assets::PropertyName;
using assets::PropertyOwner;

struct ParameterRow {
    PropertyName property;
    const char* parameter;
};

using enum PropertyName;
/// What settingsOf() makes of each property; several can make one parameter.
constexpr std::array kParameters{
    ParameterRow{ BaseColorFactor, "baseColorFactor" },
    ParameterRow{ MetallicFactor, "metallicFactor" },
    ParameterRow{ RoughnessFactor, "roughnessFactor" },
    ParameterRow{ EmissiveFactor, "emissiveFactor" },
    ParameterRow{ EmissiveStrength, "emissiveFactor" },
    ParameterRow{ AlphaCutoff, "_maskThreshold" },
    ParameterRow{ NormalScale, "normalScale" },
    ParameterRow{ BumpFactor, "bumpFactor" },
    ParameterRow{ OcclusionStrength, "occlusionStrength" },
    ParameterRow{ AnisotropyStrength, "anisotropyStrength" },
    ParameterRow{ AnisotropyRotation, "anisotropyRotation" },
    ParameterRow{ ClearCoat, "clearCoat" },
    ParameterRow{ ClearCoatRoughness, "clearCoatRoughness" },
    ParameterRow{ ClearCoatNormalScale, "clearCoatNormalScale" },
    ParameterRow{ DiffuseTransmission, "diffuseTransmission" },
    ParameterRow{ DiffuseTransmissionColor, "diffuseTransmissionColor" },
    ParameterRow{ Dispersion, "dispersion" },
    ParameterRow{ Ior, "ior" },
    ParameterRow{ Iridescence, "iridescence" },
    ParameterRow{ IridescenceIor, "iridescenceIor" },
    ParameterRow{ IridescenceThicknessMin, "iridescenceThickness" },
    ParameterRow{ IridescenceThicknessMax, "iridescenceThickness" },
    ParameterRow{ SheenColor, "sheenColor" },
    ParameterRow{ SheenRoughness, "sheenRoughness" },
    ParameterRow{ Specular, "specularFactor" },
    ParameterRow{ SpecularColor, "specularColorFactor" },
    ParameterRow{ Transmission, "transmission" },
    ParameterRow{ Thickness, "thickness" },
    ParameterRow{ AttenuationDistance, "absorption" },
    ParameterRow{ AttenuationColor, "absorption" },
};

struct MapRow {
    MapName map;
    std::string_view stem;
    const char* matrix; ///< the parameter
};
constexpr std::array kMaps{
    MapRow{ MapName::BaseColor, "baseColor", "baseColorUvMatrix" },
    MapRow{ MapName::MetallicRoughness, "metallicRoughness", "metallicRoughnessUvMatrix" },
    MapRow{ MapName::Normal, "normal", "normalUvMatrix" },
    MapRow{ MapName::Occlusion, "occlusion", "occlusionUvMatrix" },
    MapRow{ MapName::Emissive, "emissive", "emissiveUvMatrix" },
    MapRow{ MapName::Bump, "bump", "bumpUvMatrix" },
    MapRow{ MapName::ClearCoat, "clearCoat", "clearCoatUvMatrix" },
    MapRow{ MapName::ClearCoatNormal, "clearCoatNormal", "clearCoatNormalUvMatrix" },
    MapRow{ MapName::Sheen, "sheen", "sheenUvMatrix" },
    MapRow{ MapName::Specular, "specular", "specularUvMatrix" },
    MapRow{ MapName::Anisotropy, "anisotropy", "anisotropyUvMatrix" },
    MapRow{ MapName::Iridescence, "iridescence", "iridescenceUvMatrix" },
    MapRow{ MapName::Transmission, "transmission", "transmissionUvMatrix" },
    MapRow{ MapName::DiffuseTransmission, "diffuseTransmission", "diffuseTransmissionUvMatrix" },
};

void require(Result<void> const& result) {
    if (!result) log(Severity::Error, "{}", result.error().message);
    FILAMENT_ASSERT(result.ok(), "the materials of a model have the parameters that animations of the model change");
}

MapRow const& rowOf(MapName map) { return *std::ranges::find(kMaps, map, &MapRow::map); }

/// Whether the material has what the property changes: maps can be left out.
bool hasTarget(GltfMaterialSettings const& settings, AnimatedProperty const& property) {
    return property.map == MapName::None ||
           std::ranges::any_of(settings.maps, [&](GltfMap const& map) { return map.stem == rowOf(property.map).stem; });
}

/// What the property changes of an instance with these parameters; nothing where its material does not have it.
void setParameter(Engine::Impl& engine, MaterialInstance instance, assets::MaterialData& material,
                  GltfParameters const& parameters, AnimatedProperty const& property) {
    if (property.map != MapName::None) {
        const float3x3 matrix = mapOf(material, property.map).uvTransform;
        return require(engine.set(instance, rowOf(property.map).matrix, matrix));
    }
    auto const* row = std::ranges::find(kParameters, property.name, &ParameterRow::property);
    FILAMENT_ASSERT(row != kParameters.end(), "every animated property of a material is a parameter");
    for (auto const& [name, value] : parameters) {
        if (std::string_view(name) == row->parameter) require(engine.set(instance, name, value));
    }
}

/// By node: whether it and all above are visible.
void findShownNodes(Model::Impl const& model, std::span<const uint8_t> isVisible, std::vector<uint8_t>& isShown) {
    isShown.resize(model.nodes.size());
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const uint32_t parent = model.nodes[i].parent, with = model.nodes[i].visibleWith;
        isShown[i] = isVisible[i] && (parent == Model::Impl::kRoot || isShown[parent]) &&
                     (with == Model::Impl::kRoot || isShown[with]);
    }
}

/// By node: whether an animation can change if it is shown.
std::vector<uint8_t> changingNodes(Model::Impl const& model) {
    std::vector<uint8_t> isLasting(model.nodes.size(), 1);
    for (AnimatedProperty const& property : model.properties) {
        if (property.owner == PropertyOwner::Node) isLasting[property.object] = 0;
    }
    std::vector<uint8_t> isChanging;
    findShownNodes(model, isLasting, isChanging);
    for (uint8_t& node : isChanging) node = !node;
    return isChanging;
}

std::vector<uint8_t> visibleAtRest(Model::Impl const& model) {
    std::vector<uint8_t> isVisible;
    for (Model::Impl::PartNode const& node : model.nodes) isVisible.push_back(node.isVisible);
    return isVisible;
}

/// Changes one property of a light: what the program set of the others stays.
void changeLight(Scene::Impl& scene, Light light, assets::LightData const& data, PropertyName property, bool isShown) {
    if (!scene.data.lights.index.contains(light)) return;
    scene::LightRecord record = scene.data.lights.records[scene.data.lights.index.at(light)];
    if (property == LightColor) record.color = data.color;
    if (property == LightIntensity) record.intensity = isShown ? data.intensity : 0;
    if (property == LightRange) record.rangeMeters = data.rangeMeters;
    const bool isCone = property == LightInnerCone || property == LightOuterCone;
    if (isCone && record.type == scene::LightRecord::Type::Spot) { // one limits the other
        record.innerConeRadians = data.innerConeRadians;
        record.outerConeRadians = data.outerConeRadians;
    }
    if (scene.data.atNodes.lights.isAttached(light)) { // the record has the pose in the world
        scene::LightPose const& pose = scene.data.atNodes.lightPoses[light.index()];
        record.positionWorld = pose.position;
        record.directionWorld = pose.direction;
        record.sideWorld = pose.side;
    }
    scene::setLight(scene.changed(), light, record);
}

/// Renderables and lights of visible nodes are shown, those of others are not; the program keeps what no animation
/// hides. `isShown`: findShownNodes(). `isChanging`: changingNodes(). `lights`: of the file.
void show(Model::Impl const& model, Scene::Impl& scene, CopyOfModel const& copy, std::span<const uint8_t> isShown,
          std::span<const uint8_t> isChanging, std::span<const assets::LightData> lights) {
    for (size_t i = 0; i < copy.renderables.size(); ++i) {
        const Renderable renderable = copy.renderables[i];
        const uint32_t node = model.renderables[i].ofNode;
        if (isChanging[node] && scene.data.renderables.index.contains(renderable))
            scene::setVisible(scene.changed().renderables, renderable, isShown[node]);
    }
    for (size_t i = 0; i < copy.lights.size(); ++i) {
        Model::Impl::PartLight const& part = model.lights[i];
        if (isChanging[part.node])
            changeLight(scene, copy.lights[i], lights[part.source], LightIntensity, isShown[part.node]);
    }
}

} // namespace

ModelParts::ModelParts(Model::Impl const& model, Scene::Impl& scene, Node root)
        : mModel(model), mScene(scene), mRoot(root) {
    if (model.properties.empty()) return;
    for (Model::Impl::AnimatedMaterial const& material : model.animatedMaterials) {
        mMaterials.push_back(material.data);
        const GltfMaterialSettings settings = settingsOf(material.data, false, 1, model.maxMaps);
        std::vector<uint32_t>& targets = mTargets.emplace_back();
        for (const uint32_t i : material.properties) {
            if (hasTarget(settings, model.properties[i])) targets.push_back(i);
        }
    }
    mLights = model.lightsOfFile;
    mIsVisible = visibleAtRest(model);
    mIsChanging = changingNodes(model);
    findShownNodes(model, mIsVisible, mIsShown);
}

void ModelParts::write(std::span<const float4> values, std::span<const uint8_t> isMoved) {
    if (std::ranges::count(isMoved, uint8_t{ 1 }) == 0) return;
    CopyOfModel* const copy = mScene.copies.find(mRoot);
    if (!copy) return;
    bool movesLights = false, movesVisibility = false;
    for (size_t i = 0; i < isMoved.size(); ++i) {
        AnimatedProperty const& property = mModel.properties[i];
        if (!isMoved[i] || property.object == kNone) continue;
        switch (property.owner) {
        case PropertyOwner::Node:
            mIsVisible[property.object] = values[i].x != 0;
            movesVisibility = true;
            break;
        case PropertyOwner::Light:
            setValue(mLights[property.object], property.name, values[i]);
            movesLights = true;
            break;
        case PropertyOwner::Camera:
            if (copy->cameras.empty()) copy->cameras = mModel.camerasOfFile;
            setValue(copy->cameras[property.object], property.name, values[i]);
            break;
        case PropertyOwner::Material:
            break;
        }
    }
    for (size_t i = 0; i < mMaterials.size(); ++i) writeMaterial(i, values, isMoved);
    if (movesVisibility) {
        findShownNodes(mModel, mIsVisible, mIsShown);
        show(mModel, mScene, *copy, mIsShown, mIsChanging, mLights);
    }
    if (movesLights) writeLights(isMoved);
}

void ModelParts::writeMaterial(size_t animated, std::span<const float4> values, std::span<const uint8_t> isMoved) {
    Model::Impl::AnimatedMaterial const& shared = mModel.animatedMaterials[animated];
    CopyOfModel& copy = *mScene.copies.find(mRoot);
    bool isChanged = false;
    for (const uint32_t i : shared.properties) {
        if (!isMoved[i]) continue;
        setValue(mMaterials[animated], mModel.properties[i].name, mModel.properties[i].map, values[i]);
        isChanged = true;
    }
    if (!isChanged) return;
    for (Model::Impl::AnimatedInstance const& each : shared.instances) {
        const MaterialInstance own = ownInstance(mScene, copy, each.instance);
        readParameters(mMaterials[animated], each.hasVertexColor, each.scale, mParameters);
        for (const uint32_t i : mTargets[animated]) {
            if (isMoved[i]) setParameter(mScene.engine, own, mMaterials[animated], mParameters, mModel.properties[i]);
        }
    }
}

void ModelParts::writeLights(std::span<const uint8_t> isMoved) {
    CopyOfModel const& copy = *mScene.copies.find(mRoot);
    for (size_t i = 0; i < copy.lights.size(); ++i) {
        Model::Impl::PartLight const& part = mModel.lights[i];
        for (size_t k = 0; k < isMoved.size(); ++k) {
            AnimatedProperty const& property = mModel.properties[k];
            if (isMoved[k] && property.owner == PropertyOwner::Light && property.object == part.source)
                changeLight(mScene, copy.lights[i], mLights[part.source], property.name, mIsShown[part.node]);
        }
    }
}

void hideAsInFile(Model::Impl const& model, Scene::Impl& scene, Node root) {
    const std::vector<uint8_t> isVisible = visibleAtRest(model);
    if (std::ranges::count(isVisible, uint8_t{ 0 }) == 0) return;
    std::vector<uint8_t> isShown;
    findShownNodes(model, isVisible, isShown);
    show(model, scene, *scene.copies.find(root), isShown, changingNodes(model), model.lightsOfFile);
}

} // namespace filament::engine
