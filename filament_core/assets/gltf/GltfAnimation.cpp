// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfAnimation.h"

#include "filament_core/assets/gltf/Accessor.h"
#include "filament_core/assets/gltf/GltfPointer.h"
#include "filament_core/assets/gltf/KeyTimes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace filament_core::assets {
namespace {

constexpr uint64_t kMaxNumbers = uint64_t{ 1 } << 26;
constexpr uint64_t kMaxChannels = uint64_t{ 1 } << 22; // one of the file moves each node that shows its mesh

/// What the readers of all animations share.
struct Shared {
    using Key = std::tuple<PropertyOwner, PropertyName, MapName, uint32_t>;

    std::vector<std::vector<uint32_t>> nodesOfMesh; ///< that have no weights of their own; by mesh of the file
    std::map<Key, uint32_t> known;                  ///< into `properties`
    std::vector<AnimatedProperty> properties;
    uint64_t numbersLeft = kMaxNumbers, channelsLeft = kMaxChannels;

    explicit Shared(GltfDocument const& document) : nodesOfMesh(document.meshes.size()) {
        for (uint32_t i = 0; i < document.nodes.size(); ++i) {
            GltfNode const& node = document.nodes[i];
            if (node.mesh != kNone && node.weights.empty()) nodesOfMesh[node.mesh].push_back(i);
        }
    }

    uint32_t indexOf(AnimatedProperty const& property) {
        const auto [entry, isNew] = known.try_emplace({ property.owner, property.name, property.map, property.object },
                                                      static_cast<uint32_t>(properties.size()));
        if (isNew) properties.push_back(property);
        return entry->second;
    }
};

uint32_t morphTargetCount(GltfMesh const& mesh) {
    size_t most = 0;
    for (GltfPrimitive const& primitive : mesh.primitives) most = std::max(most, primitive.targets.size());
    return static_cast<uint32_t>(most);
}

/// Reads one animation; a sampler is read when a channel first needs it.
class Reader {
public:
    Reader(GltfDocument& document, GltfScene const& scene, uint32_t index, std::string_view file, Shared& shared,
           Diagnostics& diagnostics)
            : mDocument(document), mScene(scene), mSource(document.animations[index]), mFile(file),
              mPath(fmt::format("animations[{}]", index)), mShared(shared), mDiagnostics(diagnostics) {}

    AnimationData read() {
        mData.name = mSource.name;
        for (size_t i = 0; i < mSource.channels.size() && mDiagnostics.ok(); ++i) readChannel(i);
        for (AnimationSampler const& sampler : mData.samplers) {
            mData.durationSeconds = std::max(mData.durationSeconds, static_cast<double>(sampler.times.back()));
        }
        warnAboutKeys();
        return std::move(mData);
    }

private:
    void readChannel(size_t index) {
        GltfAnimationChannel const& channel = mSource.channels[index];
        const std::string path = fmt::format("{}.channels[{}]", mPath, index);
        if (channel.path == AnimationPath::Property) return readProperty(channel, index, path);
        if (channel.node == kNone && channel.mesh == kNone) return; // the target of another extension
        const bool isWeights = channel.path == AnimationPath::Weights;
        const uint32_t width = isWeights ? widthOfWeights(channel) : channel.path == AnimationPath::Rotation ? 4 : 3;
        if (width == 0) {
            if (channel.weight == kNone && channel.node != kNone)
                mDiagnostics.warn("{}: nodes[{}] has no morph targets; the channel is left out", path, channel.node);
            else
                mDiagnostics.warn("{}: there is no such morph target; the channel is left out", path);
            return;
        }
        const std::optional<uint32_t> sampler = samplerFor(channel, width, path);
        if (!sampler) return;
        if (mRepairs[*sampler].any()) mMended.push_back(index);
        const AnimationChannel moved{ .sampler = *sampler, .path = channel.path, .weight = channel.weight };
        if (isWeights && channel.node == kNone) {
            for (const uint32_t source : mShared.nodesOfMesh[channel.mesh]) add(moved, mScene.meshNodes[source]);
        } else if (isWeights) {
            add(moved, mScene.meshNodes[channel.node]);
        } else if (const uint32_t node = mScene.nodeOf[channel.node]; node != kNone) {
            add(moved, { &node, 1 });
        }
    }

    void add(AnimationChannel channel, std::span<const uint32_t> nodes) {
        if (nodes.size() > mShared.channelsLeft)
            return mDiagnostics.refuse(ErrorCode::Unsupported, "{}: the animations move more than {} nodes", mPath,
                                       kMaxChannels);
        mShared.channelsLeft -= nodes.size();
        for (const uint32_t node : nodes) {
            channel.node = node;
            mData.channels.push_back(channel);
        }
    }

    /// Numbers in a key; 0: there are no such weights.
    uint32_t widthOfWeights(GltfAnimationChannel const& channel) const {
        const uint32_t mesh = channel.node == kNone ? channel.mesh : mDocument.nodes[channel.node].mesh;
        const uint32_t count = mesh == kNone ? 0 : morphTargetCount(mDocument.meshes[mesh]);
        return channel.weight == kNone ? count : channel.weight < count ? 1 : 0;
    }

    void readProperty(GltfAnimationChannel const& channel, size_t index, std::string const& path) {
        AnimatedProperty property = channel.property;
        if (property.owner == PropertyOwner::Node) property.object = mScene.nodeOf[property.object];
        if (property.object == kNone || !hasItsType(channel, path) || !hasItsTexture(channel)) return;
        const std::optional<uint32_t> sampler = samplerFor(channel, rowOf(property.name).width, path);
        if (!sampler) return;
        if (mRepairs[*sampler].any()) mMended.push_back(index);
        const uint32_t known = mShared.indexOf(property);
        add({ .sampler = *sampler, .path = AnimationPath::Property }, { &known, 1 });
    }

    /// KHR_animation_pointer: the table of types, and STEP for booleans.
    bool hasItsType(GltfAnimationChannel const& channel, std::string const& path) {
        GltfAnimationSampler const& sampler = mSource.samplers[channel.sampler];
        GltfAccessor const& output = mDocument.accessors[sampler.output];
        const uint32_t width = rowOf(channel.property.name).width;
        if (output.components != width) {
            mDiagnostics.warn("{}: its values have {} numbers, its property {}; the channel is left out", path,
                              output.components, width);
            return false;
        }
        if (!isBoolean(channel.property.name)) return true;
        if (output.component == ComponentType::UByte && sampler.interpolation == Interpolation::Step) return true;
        mDiagnostics.warn("{}: a boolean needs unsigned bytes and STEP; the channel is left out", path);
        return false;
    }

    bool hasItsTexture(GltfAnimationChannel const& channel) {
        if (channel.property.map == MapName::None) return true;
        GltfMaterial& material = mDocument.materials[channel.property.object];
        return textureInfoOf(material, channel.property.map)->texture != kNone;
    }

    std::optional<uint32_t> samplerFor(GltfAnimationChannel const& channel, uint32_t width, std::string const& path) {
        const auto [known, isNew] = mKnown.try_emplace({ channel.sampler, channel.path, width }, std::nullopt);
        if (!isNew) return known->second;
        Diagnostics found;
        AnimationSampler sampler = readSampler(mSource.samplers[channel.sampler], width, found);
        if (!found.ok()) {
            mKnown.erase(known); // the next channel may move something of the scene
            settle(std::move(found), channel.isReached, mDiagnostics);
            return std::nullopt;
        }
        sampler.isRotation = channel.path == AnimationPath::Rotation;
        // The count is checked before keys are repaired: dropping a key drops its values, too.
        if (!hasItsValues(sampler, path)) return std::nullopt;
        const KeyRepairs repairs = mendKeys(sampler);
        if (sampler.times.empty()) {
            mDiagnostics.warn("{}: no key has a finite time and value; the channel is left out", path);
            return std::nullopt;
        }
        mRepairs.push_back(repairs);
        mData.samplers.push_back(std::move(sampler));
        known->second = static_cast<uint32_t>(mData.samplers.size() - 1);
        return known->second;
    }

    AnimationSampler readSampler(GltfAnimationSampler const& source, uint32_t width, Diagnostics& found) {
        AnimationSampler sampler{ .interpolation = source.interpolation, .width = width };
        const uint64_t keys = mDocument.accessors[source.input].count;
        GltfAccessor const& output = mDocument.accessors[source.output];
        const uint64_t numbers = keys + output.count * output.components;
        if (numbers > mShared.numbersLeft) {
            found.refuse(ErrorCode::Unsupported, "{}: the animations have more than {} numbers", mPath, kMaxNumbers);
            return sampler;
        }
        mShared.numbersLeft -= numbers;
        const uint8_t one = 1;
        if (!checkAccessor(mDocument, source.input, { &one, 1 }, "the times of an animation", found)) return sampler;
        sampler.times.resize(keys);
        readFloatsAsStored(mDocument, source.input, sampler.times); // mendKeys() drops keys that are not finite
        const uint8_t components = output.components;
        if (!checkAccessor(mDocument, source.output, { &components, 1 }, "the values of an animation", found))
            return sampler;
        sampler.values.resize(output.count * output.components);
        readFloatsAsStored(mDocument, source.output, sampler.values);
        return sampler;
    }

    bool hasItsValues(AnimationSampler const& sampler, std::string const& path) {
        const size_t keys = sampler.times.size();
        const size_t rows = sampler.interpolation == Interpolation::CubicSpline ? 3 : 1;
        if (keys > 0 && sampler.values.size() == keys * rows * sampler.width) return true;
        mDiagnostics.warn("{}: {} values for {} keys of {} numbers{}; the channel is left out", path,
                          sampler.values.size(), keys, sampler.width, rows == 3 ? " with their tangents" : "");
        return false;
    }

    /// One line for all channels: files with this fault have it everywhere.
    void warnAboutKeys() {
        if (mMended.empty()) return;
        KeyRepairs all;
        for (KeyRepairs const& repairs : mRepairs) all += repairs;
        const char* what = all.broken > 0 ? "are broken" : "do not grow from 0 on";
        mDiagnostics.warn("{}: {} '{}': the {} of channels {} {}: {}", mFile, mPath, mSource.name.substr(0, 80),
                          all.broken > 0 ? "keys" : "times", listOfNumbers(mMended), what, toString(all));
    }

    GltfDocument& mDocument;
    GltfScene const& mScene;
    GltfAnimation const& mSource;
    std::string_view mFile;
    std::string mPath;
    Shared& mShared;
    Diagnostics& mDiagnostics;
    AnimationData mData;
    std::vector<KeyRepairs> mRepairs; // parallel to mData.samplers
    std::vector<size_t> mMended;      // channels of these
    std::map<std::tuple<uint32_t, AnimationPath, uint32_t>, std::optional<uint32_t>> mKnown;
};

} // namespace

GltfAnimations readAnimations(GltfDocument& document, GltfScene const& scene, std::string_view file,
                              Diagnostics& diagnostics) {
    GltfAnimations read;
    Shared shared(document);
    for (uint32_t i = 0; i < document.animations.size() && diagnostics.ok(); ++i) {
        read.animations.push_back(Reader(document, scene, i, file, shared, diagnostics).read());
    }
    read.properties = std::move(shared.properties);
    return read;
}

} // namespace filament_core::assets
