// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/ModelParts.h"

#include "base/Assert.h"
#include "base/Log.h"
#include "filament_core/engine/gltf/CopiesOfModels.h"
#include "filament_core/engine/gltf/GltfMaterialSettings.h"
#include "filament_core/scene/SceneNodes.h"

#include <algorithm>
#include <array>

namespace filament_core::engine {
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
/// The parameters of each property by settingsOf(); several can share one parameter.
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
    ParameterRow{ MultiscatterColor, "multiscatterColor" },
    ParameterRow{ ScatterAnisotropy, "scatterAnisotropy" },
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
    MapRow{ MapName::ClearCoatRoughness, "clearCoatRoughness", "clearCoatRoughnessUvMatrix" },
    MapRow{ MapName::ClearCoatNormal, "clearCoatNormal", "clearCoatNormalUvMatrix" },
    MapRow{ MapName::Sheen, "sheen", "sheenUvMatrix" },
    MapRow{ MapName::SheenRoughness, "sheenRoughness", "sheenRoughnessUvMatrix" },
    MapRow{ MapName::Specular, "specular", "specularUvMatrix" },
    MapRow{ MapName::SpecularFactor, "specularFactor", "specularFactorUvMatrix" },
    MapRow{ MapName::Anisotropy, "anisotropy", "anisotropyUvMatrix" },
    MapRow{ MapName::Iridescence, "iridescence", "iridescenceUvMatrix" },
    MapRow{ MapName::IridescenceThickness, "iridescenceThickness", "iridescenceThicknessUvMatrix" },
    MapRow{ MapName::Transmission, "transmission", "transmissionUvMatrix" },
    MapRow{ MapName::Thickness, "thickness", "thicknessUvMatrix" },
    MapRow{ MapName::DiffuseTransmission, "diffuseTransmission", "diffuseTransmissionUvMatrix" },
    MapRow{ MapName::DiffuseTransmissionFactor, "diffuseTransmissionFactor", "diffuseTransmissionFactorUvMatrix" },
    MapRow{ MapName::Multiscatter, "multiscatter", "multiscatterUvMatrix" },
    MapRow{ MapName::Light, "light", "lightUvMatrix" },
};

void requireDone(Result<void> const& result) {
    if (!result) log(Severity::Error, "{}", result.error().message);
    FILAMENT_ASSERT(result.ok(), "the materials of a model have the parameters that animations of the model change");
}

MapRow const& rowOf(MapName map) { return *std::ranges::find(kMaps, map, &MapRow::map); }

/// What the property changes of an instance with these parameters; nothing where its material does not have it.
void setParameter(Engine::Impl& engine, MaterialInstance instance, assets::MaterialData& material,
                  GltfParameters const& parameters, AnimatedProperty const& property) {
    if (property.map != MapName::None) {
        const float3x3 matrix = mapOf(material, property.map).uvTransform;
        return requireDone(engine.set(instance, rowOf(property.map).matrix, matrix));
    }
    auto const* row = std::ranges::find(kParameters, property.name, &ParameterRow::property);
    FILAMENT_ASSERT(row != kParameters.end(), "every animated property of a material is a parameter");
    for (auto const& [name, value] : parameters) {
        if (std::string_view(name) == row->parameter) requireDone(engine.set(instance, name, value));
    }
}

/// By node: whether it and all above have a mark.
template <class Marks>
void markWithParents(Model::Impl const& model, Marks const& hasMark, std::vector<uint8_t>& isMarked) {
    isMarked.resize(model.nodes.size());
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const uint32_t parent = model.nodes[i].parent, with = model.nodes[i].visibleWith;
        isMarked[i] = hasMark(i) && (parent == Model::Impl::kRoot || isMarked[parent]) &&
                      (with == Model::Impl::kRoot || isMarked[with]);
    }
}

void findShownNodes(Model::Impl const& model, ShownParts& parts) {
    const auto isShown = [&](size_t node) {
        const bool isVisible = parts.isVisible.empty() ? model.nodes[node].isVisible : parts.isVisible[node] != 0;
        return isVisible && (parts.isOtherLevel.empty() || !parts.isOtherLevel[node]);
    };
    markWithParents(model, isShown, parts.isShown);
}

std::vector<assets::LightData> const& lightsOf(Model::Impl const& model, ShownParts const& parts) {
    return parts.lights.empty() ? model.lightsOfFile : parts.lights;
}

/// Changes one property of a light; the others keep the program's values.
void changeLight(Scene::Impl& scene, Light light, assets::LightData const& data, PropertyName property, bool isShown) {
    if (!scene.data.lights.index.contains(light)) return;
    scene::LightRecord record = scene.data.lights.records[scene.data.lights.index.at(light)];
    if (property == LightColor) record.color = data.color;
    const bool isArea = data.shape != assets::AreaShape::None;
    if (property == LightIntensity) record.intensity = !isShown ? 0 : isArea ? data.luminance : data.intensity;
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

} // namespace

namespace {

std::vector<uint8_t> visibleAtRest(Model::Impl const& model) {
    std::vector<uint8_t> isVisible;
    for (Model::Impl::PartNode const& node : model.nodes) isVisible.push_back(node.isVisible);
    return isVisible;
}

void markOtherLevels(Model::Impl const& model, ShownParts& parts) {
    if (model.levels.empty()) return;
    parts.isOtherLevel.assign(model.nodes.size(), 0);
    for (size_t i = 0; i < model.levels.size(); ++i) {
        std::vector<uint32_t> const& nodes = model.levels[i].nodes;
        for (size_t k = 0; k < nodes.size(); ++k) parts.isOtherLevel[nodes[k]] = k != parts.levels[i];
    }
}

/// The box in the world of each node with all that is below it, shown or not.
void findBoxes(Model::Impl const& model, scene::SceneData const& scene, CopyOfModel& copy) {
    std::vector<Box>& boxes = copy.parts.boxes;
    boxes.assign(model.nodes.size(), Box{});
    const auto grow = [&](uint32_t node, Box const& by) {
        if (node != Model::Impl::kRoot && !by.empty()) boxes[node].add(by);
    };
    for (size_t i = 0; i < copy.renderables.size(); ++i) {
        if (scene.renderables.index.contains(copy.renderables[i]))
            grow(model.renderables[i].ofNode,
                 scene.renderables.bounds.at(scene.renderables.index.at(copy.renderables[i])));
    }
    // From the last to the first: children stand behind their parents, so each box is complete before it is passed on.
    for (size_t i = model.nodes.size(); i-- > 0;) {
        grow(model.nodes[i].parent, boxes[i]);
        grow(model.nodes[i].visibleWith, boxes[i]);
    }
}

} // namespace

void showParts(Model::Impl const& model, Scene::Impl& scene, CopyOfModel& copy) {
    findShownNodes(model, copy.parts);
    std::vector<uint8_t> const& isShown = copy.parts.isShown;
    for (size_t i = 0; i < copy.renderables.size(); ++i) {
        const Renderable renderable = copy.renderables[i];
        const uint32_t node = model.renderables[i].ofNode;
        if (model.mayChange[node] && scene.data.renderables.index.contains(renderable))
            scene::setVisible(scene.changed().renderables, renderable, isShown[node]);
    }
    for (size_t i = 0; i < copy.lights.size(); ++i) {
        Model::Impl::PartLight const& part = model.lights[i];
        if (model.mayChange[part.node])
            changeLight(scene, copy.lights[i], lightsOf(model, copy.parts)[part.source], LightIntensity,
                        isShown[part.node]);
    }
}

bool hasTarget(GltfMaterialSettings const& settings, AnimatedProperty const& property) {
    return property.map == MapName::None ||
           std::ranges::any_of(settings.maps, [&](GltfMap const& map) { return map.stem == rowOf(property.map).stem; });
}

void findChangingNodes(Model::Impl& model) {
    std::vector<uint8_t> mayChange(model.nodes.size(), 0);
    for (AnimatedProperty const& property : model.properties) {
        if (property.name == NodeVisible) mayChange[property.object] = 1;
    }
    for (assets::LevelsData const& levels : model.levels) {
        for (const uint32_t node : levels.nodes) mayChange[node] = 1;
    }
    markWithParents(
            model, [&](size_t node) { return !mayChange[node]; }, model.mayChange);
    for (uint8_t& node : model.mayChange) node = !node;
}

ModelParts::ModelParts(Model::Impl const& model, Scene::Impl& scene, Node root)
        : mModel(model), mScene(scene), mRoot(root) {
    if (model.properties.empty()) return;
    for (Model::Impl::AnimatedMaterial const& material : model.animatedMaterials) mMaterials.push_back(material.data);
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
            if (property.name != NodeVisible) {
                const Node node = copy->nodes[property.object];
                const PickAim aim = property.name == NodeSelectable ? PickAim::Select : PickAim::Hover;
                if (mScene.data.transforms.isAlive(node)) scene::setPickable(mScene.data, node, aim, values[i].x != 0);
                break;
            }
            if (copy->parts.isVisible.empty()) copy->parts.isVisible = visibleAtRest(mModel);
            copy->parts.isVisible[property.object] = values[i].x != 0;
            movesVisibility = true;
            break;
        case PropertyOwner::Light:
            if (copy->parts.lights.empty()) copy->parts.lights = mModel.lightsOfFile;
            setValue(copy->parts.lights[property.object], property.name, values[i]);
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
    if (movesVisibility) showParts(mModel, mScene, *copy);
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
        readParameters(mMaterials[animated], each.vertices, each.scale, mParameters);
        for (const uint32_t i : each.targets) {
            if (isMoved[i]) setParameter(mScene.engine, own, mMaterials[animated], mParameters, mModel.properties[i]);
        }
    }
}

void ModelParts::writeLights(std::span<const uint8_t> isMoved) {
    CopyOfModel& copy = *mScene.copies.find(mRoot);
    if (copy.parts.isShown.empty()) findShownNodes(mModel, copy.parts);
    for (size_t i = 0; i < copy.lights.size(); ++i) {
        Model::Impl::PartLight const& part = mModel.lights[i];
        for (size_t k = 0; k < isMoved.size(); ++k) {
            AnimatedProperty const& property = mModel.properties[k];
            if (isMoved[k] && property.owner == PropertyOwner::Light && property.object == part.source)
                changeLight(mScene, copy.lights[i], copy.parts.lights[part.source], property.name,
                            copy.parts.isShown[part.node]);
        }
    }
}

void setPickRules(Model::Impl const& model, Scene::Impl& scene, std::span<const Node> nodes) {
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        Model::Impl::PartNode const& node = model.nodes[i];
        if (!node.isSelectable) scene::setPickable(scene.data, nodes[i], PickAim::Select, false);
        if (!node.isHoverable) scene::setPickable(scene.data, nodes[i], PickAim::Hover, false);
        if (node.visibleWith != Model::Impl::kRoot)
            scene.data.atNodes.pickRules.follow(nodes[i].index(), nodes[node.visibleWith]);
    }
}

void hideAsInFile(Model::Impl const& model, Scene::Impl& scene, Node root) {
    CopyOfModel& copy = *scene.copies.find(root);
    copy.parts.levels.resize(model.levels.size(), 0);
    markOtherLevels(model, copy.parts);
    if (!model.levels.empty() || !std::ranges::all_of(model.nodes, &Model::Impl::PartNode::isVisible))
        showParts(model, scene, copy);
}

void chooseLevels(Model::Impl const& model, Scene::Impl& scene, CopyOfModel& copy, prepare::CoverageLens const& lens,
                  double bias) {
    findBoxes(model, scene.upToDate(), copy);
    bool isChanged = false;
    for (size_t i = 0; i < model.levels.size(); ++i) {
        Box const& box = copy.parts.boxes[model.levels[i].nodes[0]];
        const double radius = box.empty() ? 0 : 0.5 * glm::distance(box.min, box.max);
        const double coverage = bias * prepare::screenCoverage(lens, box.center(), radius);
        const uint32_t level = prepare::levelFor(model.levels[i].leastCoverage, coverage);
        isChanged |= std::exchange(copy.parts.levels[i], level) != level;
    }
    if (!isChanged) return;
    markOtherLevels(model, copy.parts);
    showParts(model, scene, copy);
}

} // namespace filament_core::engine
