// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/ModelUpload.h"

#include "base/math/Elementary.h"
#include "base/math/SharedExponent.h"
#include "filament_core/engine/EnvironmentImpl.h"
#include "filament_core/engine/SharedBytes.h"
#include "filament_core/engine/TextureStreamer.h"
#include "filament_core/engine/gltf/GltfMaterials.h"
#include "filament_core/engine/gltf/ModelParts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace filament_core::engine {

using assets::kNone;
using assets::ModelData;
using assets::PrimitiveData;

/// Uploads one ModelData and places its meshes; each step fills a part of the Model.
class ModelUpload::Builder {
public:
    Builder(Engine::Impl& engine, ReadModel model)
            : mEngine(engine), mData(std::move(model.data)), mLight(std::move(model.light)),
              mShapes(std::move(model.shapes)), mImages(std::move(model.images)),
              mModel(std::make_unique<Model::Impl>(Engine::of(engine))),
              mMaterials(mEngine, *mModel, mModel->textures, std::move(model.materials), model.hasSections) {
        mModel->bounds = model.bounds;
        mModel->name = mData.name;
        mModel->warnings = mData.warnings;
        mModel->animations = std::move(mData.animations);
        mModel->variants = mData.variants;
        mModel->source = std::move(model.source);
    }

    size_t stepCount() const { return mData.images.size() + mData.meshes.size() + 1; }

    size_t step(size_t index) {
        if (index < mData.images.size()) return uploadImage(mData.images[index]);
        index -= mData.images.size();
        return index < mData.meshes.size() ? uploadMesh(mData.meshes[index]) : uploadEnvironment();
    }

    std::unique_ptr<Model::Impl> finish() {
        // Before the nodes: placing a mesh makes instances of volumes, which must be noted as animated, too. Profiles
        // as well, which lights of nodes name.
        keepAnimated();
        for (assets::LightProfileData const& profile : mData.profiles) {
            mModel->profiles.push_back({});
            mModel->profiles.back() = mEngine.createLightProfile(profile.file, profile.name);
        }
        placeNodes();
        keepOrigins();
        findChangingNodes(*mModel);
        return std::move(mModel);
    }

private:
    struct Part {
        RenderableDesc desc{};
        PrimitiveData const* primitive = nullptr;
        double4x4 meshFromPositions{ 1.0 };
        bool isScaled = false;
        bool isSkinned = false;
        std::vector<std::string> targetNames{};
    };

    size_t uploadImage(assets::Image& image) {
        mModel->textures.push_back({}); // reserve the entry before the object exists
        const SharedBytes texels = sharedBytes(image.data);
        mModel->textures.back() = mEngine.createTexture({ .format = image.format,
                                                          .width = image.width,
                                                          .height = image.height,
                                                          .levels = image.levels,
                                                          .pixels = *texels,
                                                          .name = mData.name },
                                                        texels);
        if (mImages) stream(texels);
        return texels->size();
    }

    void stream(SharedBytes const& texels) {
        const auto slot = static_cast<uint32_t>(mModel->textures.size() - 1);
        if (!mImages->textures()[slot].isStreamed()) return;
        TextureStreamer& streamer = mEngine.streamerOf();
        streamer.options.budgetMegabytes = std::max(streamer.options.budgetMegabytes, mImages->budgetMegabytes);
        streamer.add(mModel->textures.back(), mImages, slot, texels);
    }

    size_t uploadEnvironment() {
        if (!mLight) return 0;
        std::string const& name = mData.imageBasedLight->name;
        const size_t bytes = mLight->specular.data.size() + mLight->sky.data.size();
        mModel->environment = engine::uploadEnvironment(Engine::of(mEngine), std::move(*mLight),
                                                        name.empty() ? mData.name + " light" : name);
        return bytes;
    }

    size_t uploadMesh(assets::MeshData& mesh) {
        size_t bytes = 0;
        std::vector<ReadModel::Shape> const& shapes = mShapes[mMeshes.size()];
        std::vector<Part>& parts = mMeshes.emplace_back();
        for (PrimitiveData& primitive : mesh.primitives) {
            bytes += primitive.indices.size() + primitive.vertices.size();
            // In the order of the meshes, which determines the order of draws.
            if (!primitive.splats && !isSolid(materialOf(primitive.material)))
                instanceFor(primitive.material, verticesOf(primitive), double4x4(1.0));
            parts.push_back(
                    { upload(primitive, shapes[parts.size()], mesh.name), &primitive, meshFromPositions(primitive),
                      primitive.positionScale != 1 || primitive.positionOffset != float3(0), primitive.isSkinned });
            if (!primitive.morphTargets.empty()) parts.back().targetNames = mesh.targetNames;
        }
        return bytes;
    }

    RenderableDesc upload(PrimitiveData& primitive, ReadModel::Shape const& shape, std::string const& name) {
        if (primitive.splats) return { .splats = SplatCloud(primitive.splats), .name = name };
        const SharedBytes ofVertices = sharedBytes(primitive.vertices), ofIndices = sharedBytes(primitive.indices);
        VertexBufferDesc vertices{ .vertexCount = primitive.vertexCount,
                                   .stride = primitive.layout.buffers[0].stride,
                                   .data = *ofVertices,
                                   .name = name };
        for (uint32_t i = 0; i < primitive.layout.attributeCount; ++i) {
            backend::VertexAttribute const& attribute = primitive.layout.attributes[i];
            vertices.attributes.push_back(
                    { static_cast<Attribute>(attribute.location), attribute.format, attribute.offset });
        }
        mModel->vertexBuffers.push_back({});
        mModel->indexBuffers.push_back({});
        mModel->vertexBuffers.back() = mEngine.createVertexBuffer(vertices, ofVertices, shape.bounds);
        if (mImages)
            mEngine.streamerOf().addMesh(mEngine.vertexBuffers.get(mModel->vertexBuffers.back()).handle,
                                         shape.uvDensity);
        const uint32_t levels =
                shape.levels.empty() ? 0 : shape.levels.back().firstIndex + shape.levels.back().indexCount;
        mModel->indexBuffers.back() = mEngine.createIndexBuffer({ .indexCount = std::max(primitive.indexCount, levels),
                                                                  .format = primitive.indexFormat,
                                                                  .data = *ofIndices,
                                                                  .name = name },
                                                                ofIndices);
        return { .vertices = mModel->vertexBuffers.back(),
                 .indices = mModel->indexBuffers.back(),
                 .primitive = primitive.topology,
                 .indexCount = primitive.indexCount,
                 .bounds = Box{ double3(primitive.boundsMin), double3(primitive.boundsMax) },
                 .occluder = shape.occluder,
                 .levels = shape.levels,
                 .boneBounds = boneBounds(primitive),
                 .morphTargets = uploadTargets(primitive, name),
                 .name = name };
    }

    static std::vector<Box> boneBounds(PrimitiveData const& primitive) {
        std::vector<Box> bounds;
        for (assets::BoundsData const& bone : primitive.boneBounds)
            bounds.push_back({ double3(bone.min), double3(bone.max) });
        return bounds;
    }

    MorphTargets uploadTargets(PrimitiveData const& primitive, std::string const& name) {
        if (primitive.morphTargets.empty()) return {};
        MorphTargetsDesc desc{ .vertexCount = primitive.vertexCount, .name = name };
        for (assets::MorphTargetData const& target : primitive.morphTargets) {
            desc.targets.push_back({ target.positions, target.normals, target.tangents });
        }
        mModel->morphTargets.push_back({});
        return mModel->morphTargets.back() = mEngine.createMorphTargets(desc);
    }

    /// What animations of properties need of the file. The instances of meshes exist by now, those of volumes are
    /// made with their places: instanceFor() adds them.
    void keepAnimated() {
        mModel->properties = std::move(mData.animatedProperties);
        mModel->levels = std::move(mData.levels);
        if (mModel->properties.empty() && mModel->levels.empty()) return;
        mModel->lightsOfFile = mData.lights;
        mModel->camerasOfFile = mData.cameras;
        for (uint32_t i = 0; i < mModel->properties.size(); ++i) {
            assets::AnimatedProperty& property = mModel->properties[i];
            if (property.owner != assets::PropertyOwner::Material || property.object == kNone) continue;
            const auto [entry, isNew] = mAnimatedMaterials.try_emplace(
                    property.object, static_cast<uint32_t>(mModel->animatedMaterials.size()));
            if (isNew) mModel->animatedMaterials.push_back({ mData.materials[property.object], {}, {} });
            mModel->animatedMaterials[entry->second].properties.push_back(i);
            property.object = entry->second;
        }
        for (auto const& [key, instance] : mInstances) keepAnimated(key, instance);
    }

    using InstanceKey = std::tuple<uint32_t, GltfVertices, float>; ///< material of the file, vertices, scale

    void keepAnimated(InstanceKey const& key, MaterialInstance instance) {
        const auto& [index, vertices, scale] = key;
        const auto known = mAnimatedMaterials.find(index);
        if (known == mAnimatedMaterials.end()) return;
        Model::Impl::AnimatedMaterial& material = mModel->animatedMaterials[known->second];
        const GltfMaterialSettings settings =
                settingsOf(material.data, vertices, scale, GltfMaterials::choiceOf(mEngine).maxMaps);
        std::vector<uint32_t> targets;
        for (const uint32_t i : material.properties) {
            if (hasTarget(settings, mModel->properties[i])) targets.push_back(i);
        }
        material.instances.push_back({ instance, vertices, scale, std::move(targets) });
    }

    void keepOrigins() {
        for (const VertexBuffer buffer : mModel->vertexBuffers)
            mModel->vertexVersions.push_back(mEngine.contentVersions.of(mEngine.vertexBuffers.get(buffer).handle));
        mModel->origins.reserve(mInstances.size());
        for (auto const& [key, instance] : mInstances) {
            const auto& [index, vertices, scale] = key;
            const bool isOfFile = index < mData.materialsOfFile.size();
            Model::Impl::InstanceOrigin& origin = mModel->origins.emplace_back();
            origin = { instance, isOfFile ? mData.materialsOfFile[index] : kNone, vertices, scale, {} };
            for (scene::TextureBinding const& binding : mEngine.instances.get(instance).textures)
                origin.textures.push_back(binding.texture);
        }
    }

    void placeNodes() {
        for (uint32_t i = 0; i < mData.nodes.size(); ++i) {
            assets::NodeData const& node = mData.nodes[i];
            const uint32_t parent = node.parent == kNone ? Model::Impl::kRoot : node.parent;
            mModel->nodes.push_back({ node.name, parent, node.parentFromNode, node.pose, node.isVisible,
                                      node.isSelectable, node.isHoverable,
                                      node.visibleWith == kNone ? Model::Impl::kRoot : node.visibleWith, node.ofFile,
                                      node.carriesMesh, node.isCoarserLevel });
            if (node.mesh != kNone) placeMesh(node, i);
            for (const uint32_t light : { node.light, node.profiledLight }) {
                if (light != kNone)
                    mModel->lights.push_back({ lightOf(mData.lights[light]), i, mData.lights[light].name, light });
            }
            if (node.camera != kNone) mModel->cameras.push_back({ mData.cameras[node.camera], i, node.camera });
        }
        mModel->fileNodes = mModel->nodes.size();
        // After the nodes of the file, whose parents are indices.
        for (Model::Impl::PartNode& node : mScalingNodes) mModel->nodes.push_back(std::move(node));
    }

    void placeMesh(assets::NodeData const& node, uint32_t at) {
        uint32_t skin = Model::Impl::kNoSkin;
        if (node.skin != kNone && std::ranges::any_of(mMeshes[node.mesh], &Part::isSkinned)) {
            assets::SkinData const& source = mData.skins[node.skin];
            skin = static_cast<uint32_t>(mModel->skins.size());
            mModel->skins.push_back({ at, source.joints, source.jointFromBind });
        }
        for (Part const& part : mMeshes[node.mesh]) {
            placePart(part, at, node.worldFromNode);
            Model::Impl::PartRenderable& placed = mModel->renderables.back();
            if (part.isSkinned) placed.skin = skin;
            if (placed.desc.morphTargets) placed.desc.morphWeights = node.morphWeights;
        }
    }

    /// Positions scaled to a unit cube get a node of their own that restores their size.
    void placePart(Part const& part, uint32_t node, double4x4 const& worldFromNode) {
        uint32_t at = node;
        if (part.isScaled) {
            at = static_cast<uint32_t>(mData.nodes.size() + mScalingNodes.size());
            mScalingNodes.push_back({ .name = part.desc.name + " positions",
                                      .parent = node,
                                      .parentFromNode = part.meshFromPositions });
        }
        PrimitiveData const& primitive = *part.primitive;
        Model::Impl::PartRenderable& placed = mModel->renderables.emplace_back();
        placed.desc = part.desc;
        placed.node = at;
        placed.ofNode = node;
        placed.targetNames = part.targetNames;
        if (primitive.splats) {
            placed.desc.material = mEngine.splatInstance();
            return;
        }
        const GltfVertices vertices = verticesOf(primitive);
        placed.desc.material = instanceFor(primitive.material, vertices, worldFromNode);
        for (assets::VariantMaterial const& variant : primitive.variants)
            placed.variants.push_back({ variant.variant, instanceFor(variant.material, vertices, worldFromNode) });
    }

    assets::MaterialData const& materialOf(uint32_t index) const { return filament_core::materialOf(mData, index); }

    /// One per material and kind of vertices; if the material has a volume, also one per scale.
    MaterialInstance instanceFor(uint32_t index, GltfVertices const& vertices, double4x4 const& worldFromNode) {
        assets::MaterialData const& material = materialOf(index);
        const float scale = isSolid(material) ? scaleOf(worldFromNode) : 1.0f;
        MaterialInstance& instance = mInstances[{ index, vertices, scale }];
        if (instance) return instance;
        instance = mMaterials.instanceFor(material, vertices, scale);
        keepAnimated({ index, vertices, scale }, instance);
        return instance;
    }

    /// A body of some thickness, not a thin wall.
    static bool isSolid(assets::MaterialData const& material) {
        return material.transmission.isSolid() || material.scatters();
    }

    /// KHR_materials_volume: a thickness is in the space of the mesh and scales with its nodes. For a non-uniform
    /// scale, the geometric mean preserves the volume.
    static float scaleOf(double4x4 const& worldFromNode) {
        const double scale = elementary::cbrt(std::abs(glm::determinant(double3x3(worldFromNode))));
        return std::isfinite(scale) ? static_cast<float>(scale) : 1.0f; // NaN would be a key that is never found
    }

    static double4x4 meshFromPositions(PrimitiveData const& primitive) {
        double4x4 matrix(static_cast<double>(primitive.positionScale));
        matrix[3] = double4(double3(primitive.positionOffset), 1);
        return matrix;
    }

    // KHR_lights_punctual and EXT_lights_ies: at the origin of its node, shining along -Z, the profile's +X along +X.
    LightDesc lightOf(assets::LightData const& data) {
        LightDesc light = plainLightOf(data);
        if (data.tables) addTables(*data.tables, light);
        return light;
    }

    /// Words that the parser checked. Lights of the file that share them share what is made of them, too.
    void addTables(assets::LightTables const& tables, LightDesc& light) {
        const auto shapeOf = [](LightDesc const& of) {
            return std::holds_alternative<SunLight>(of)    ? LightImageShape::Tiled
                   : std::holds_alternative<SpotLight>(of) ? LightImageShape::Projected
                   : std::holds_alternative<RectLight>(of) ? LightImageShape::Emitted
                                                           : LightImageShape::Octahedron;
        };
        LightImage image{};
        LightProfile profile{};
        if (!tables.image.empty()) {
            image = imageOf(tables, shapeOf(light));
            mModel->lightImages.push_back(image);
        }
        if (!tables.profile.empty()) {
            profile = profileOf(tables);
            mModel->profiles.push_back(profile);
        }
        if (SunLight* const sun = std::get_if<SunLight>(&light)) {
            sun->cookie = image;
            sun->cookieMeters = tables.imageMeters;
            sun->cookieOffsetMeters = tables.imageOffset;
        } else if (PointLight* const point = std::get_if<PointLight>(&light)) {
            point->cookie = image;
            if (profile) point->profile = profile;
        } else if (SpotLight* const spot = std::get_if<SpotLight>(&light)) {
            spot->cookie = image;
            spot->profile = profile;
        } else if (RectLight* const rect = std::get_if<RectLight>(&light)) {
            rect->image = image;
        }
    }

    LightImage imageOf(assets::LightTables const& tables, LightImageShape shape) {
        mModel->lightImages.reserve(mModel->lightImages.size() + 1);
        std::vector<uint32_t> words = tables.image;
        words[3] = ++mEngine.lastLightImage;
        const float3 mean = unpackRgb9E5(words.back()); // of the last level, whose texel its border repeats
        const LightImageDescription description{ shape, words[0], words[1], mean };
        Draft draft(mEngine.lightImages);
        draft.state() = { std::make_shared<const std::vector<uint32_t>>(std::move(words)), tables.aspect, description,
                          mData.name };
        return draft.keep();
    }

    LightProfile profileOf(assets::LightTables const& tables) {
        mModel->profiles.reserve(mModel->profiles.size() + 1);
        Draft draft(mEngine.lightProfiles);
        draft.state() = { std::make_shared<const std::vector<uint32_t>>(tables.profile),
                          { Candela{ tables.peak }, Lumen{ tables.lumens } },
                          mData.name };
        return draft.keep();
    }

    LightDesc plainLightOf(assets::LightData const& light) const {
        const float3 direction(0, 0, -1);
        if (light.shape != assets::AreaShape::None) return areaOf(light);
        switch (light.type) {
        case assets::LightType::Directional:
            return SunLight{ .directionWorld = direction,
                             .illuminance = Lux{ light.intensity },
                             .color = light.color,
                             .angularRadiusDegrees = light.angularRadiusDegrees,
                             .showsDisc = light.showsDisc,
                             .haloSize = light.haloSize,
                             .haloFalloff = light.haloFalloff,
                             .castsShadows = light.castsShadows,
                             .contactShadows = light.contactShadows,
                             .lightChannels = light.channels };
        case assets::LightType::Point:
            return PointLight{ .intensity = Candela{ light.intensity },
                               .color = light.color,
                               .rangeMeters = light.rangeMeters,
                               .sourceRadiusMeters = light.sourceRadiusMeters,
                               .castsShadows = light.castsShadows,
                               .contactShadows = light.contactShadows,
                               .lightChannels = light.channels,
                               .profile = light.profile == kNone ? LightProfile{} : mModel->profiles[light.profile] };
        case assets::LightType::Spot:
            break;
        }
        return SpotLight{ .directionWorld = direction,
                          .intensity = Candela{ light.intensity },
                          .color = light.color,
                          .rangeMeters = light.rangeMeters,
                          .innerConeRadians = light.innerConeRadians,
                          .outerConeRadians = light.outerConeRadians,
                          .sourceRadiusMeters = light.sourceRadiusMeters,
                          .castsShadows = light.castsShadows,
                          .contactShadows = light.contactShadows,
                          .lightChannels = light.channels };
    }

    /// FILAMENT_light
    static LightDesc areaOf(assets::LightData const& data) {
        const auto with = [&](auto light) {
            light.luminance = Nits{ data.luminance };
            light.color = data.color;
            light.rangeMeters = data.rangeMeters;
            light.castsShadows = data.castsShadows;
            light.isVisible = data.isVisible;
            light.lightChannels = data.channels;
            return light;
        };
        if (data.shape == assets::AreaShape::Tube)
            return with(TubeLight{ .lengthMeters = data.sizeMeters.x, .radiusMeters = data.sizeMeters.y });
        if (data.shape == assets::AreaShape::Disc)
            return with(DiscLight{ .radiusMeters = data.sizeMeters.x, .isTwoSided = data.isTwoSided });
        return with(RectLight{
                .widthMeters = data.sizeMeters.x, .heightMeters = data.sizeMeters.y, .isTwoSided = data.isTwoSided });
    }

    Engine::Impl& mEngine;
    ModelData mData;
    std::optional<assets::EnvironmentData> mLight;
    std::vector<std::vector<ReadModel::Shape>> mShapes; // by mesh of the file and primitive
    ImageStore mImages;                                 // none: all textures are whole
    std::unique_ptr<Model::Impl> mModel;
    GltfMaterials mMaterials;
    std::map<InstanceKey, MaterialInstance> mInstances;
    std::map<uint32_t, uint32_t> mAnimatedMaterials; // material of the file -> of the model
    std::vector<std::vector<Part>> mMeshes;          // by mesh of the file, one per primitive
    std::vector<Model::Impl::PartNode> mScalingNodes;
};

ModelUpload::ModelUpload(Engine::Impl& engine, ReadModel model)
        : mBuilder(std::make_unique<Builder>(engine, std::move(model))) {}
ModelUpload::~ModelUpload() = default;
size_t ModelUpload::stepCount() const { return mBuilder->stepCount(); }
size_t ModelUpload::step(size_t index) { return mBuilder->step(index); }
std::unique_ptr<Model::Impl> ModelUpload::finish() { return mBuilder->finish(); }

} // namespace filament_core::engine
