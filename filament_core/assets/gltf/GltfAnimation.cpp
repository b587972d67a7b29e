// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfAnimation.h"

#include "filament_core/assets/gltf/Accessor.h"
#include "filament_core/assets/gltf/KeyTimes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace filament::assets {
namespace {

constexpr uint64_t kMaxNumbers = uint64_t{ 1 } << 26;

uint32_t morphTargetCount(GltfMesh const& mesh) {
    size_t most = 0;
    for (GltfPrimitive const& primitive : mesh.primitives) most = std::max(most, primitive.targets.size());
    return static_cast<uint32_t>(most);
}

/// Reads one animation; a sampler is read when a channel first needs it.
class Reader {
public:
    Reader(GltfDocument const& document, GltfScene const& scene, uint32_t index, std::string_view file,
           uint64_t& numbersLeft, Diagnostics& diagnostics)
            : mDocument(document), mScene(scene), mSource(document.animations[index]), mFile(file),
              mPath(fmt::format("animations[{}]", index)), mNumbersLeft(numbersLeft), mDiagnostics(diagnostics) {}

    AnimationData read() {
        mData.name = mSource.name;
        for (size_t i = 0; i < mSource.channels.size() && mDiagnostics.ok(); ++i) readChannel(i);
        for (AnimationSampler const& sampler : mData.samplers) {
            mData.durationSeconds = std::max(mData.durationSeconds, static_cast<double>(sampler.times.back()));
        }
        warnAboutTimes();
        return std::move(mData);
    }

private:
    void readChannel(size_t index) {
        GltfAnimationChannel const& channel = mSource.channels[index];
        if (channel.node == kNone) return; // the target of an extension
        const std::string path = fmt::format("{}.channels[{}]", mPath, index);
        const bool isWeights = channel.path == AnimationPath::Weights;
        const uint32_t mesh = mDocument.nodes[channel.node].mesh;
        const uint32_t width = isWeights ? (mesh == kNone ? 0 : morphTargetCount(mDocument.meshes[mesh]))
                               : channel.path == AnimationPath::Rotation ? 4
                                                                         : 3;
        if (width == 0) {
            mDiagnostics.warn("{}: nodes[{}] has no morph targets; the channel is left out", path, channel.node);
            return;
        }
        const std::optional<uint32_t> sampler = samplerFor(channel, width, path);
        if (!sampler) return;
        if (mRepairs[*sampler].any()) mMended.push_back(index);
        const auto add = [&](uint32_t node) { mData.channels.push_back({ *sampler, node, channel.path }); };
        if (isWeights) {
            for (const uint32_t node : mScene.meshNodes[channel.node]) add(node);
        } else if (const uint32_t node = mScene.nodeOf[channel.node]; node != kNone) {
            add(node);
        }
    }

    std::optional<uint32_t> samplerFor(GltfAnimationChannel const& channel, uint32_t width, std::string const& path) {
        const auto [known, isNew] = mKnown.try_emplace({ channel.sampler, channel.path, width }, std::nullopt);
        if (!isNew) return known->second;
        AnimationSampler sampler = readSampler(mSource.samplers[channel.sampler], width);
        sampler.isRotation = channel.path == AnimationPath::Rotation;
        if (!mDiagnostics.ok() || !hasItsValues(sampler, path)) return std::nullopt;
        const KeyRepairs repairs = mendKeys(sampler);
        if (sampler.times.empty()) {
            mDiagnostics.warn("{}: no key has a finite time; the channel is left out", path);
            return std::nullopt;
        }
        mRepairs.push_back(repairs);
        mData.samplers.push_back(std::move(sampler));
        known->second = static_cast<uint32_t>(mData.samplers.size() - 1);
        return known->second;
    }

    AnimationSampler readSampler(GltfAnimationSampler const& source, uint32_t width) {
        AnimationSampler sampler{ .interpolation = source.interpolation, .width = width };
        const uint64_t keys = mDocument.accessors[source.input].count;
        GltfAccessor const& output = mDocument.accessors[source.output];
        const uint64_t numbers = keys + output.count * output.components;
        if (numbers > mNumbersLeft) {
            mDiagnostics.refuse(ErrorCode::Unsupported, "{}: the animations have more than {} numbers", mPath,
                                kMaxNumbers);
            return sampler;
        }
        mNumbersLeft -= numbers;
        const uint8_t one = 1;
        if (!checkAccessor(mDocument, source.input, { &one, 1 }, "the times of an animation", mDiagnostics))
            return sampler;
        sampler.times.resize(keys);
        readFloatsAsStored(mDocument, source.input, sampler.times); // mendKeys() drops those that are not finite
        const uint8_t components = output.components;
        if (!checkAccessor(mDocument, source.output, { &components, 1 }, "the values of an animation", mDiagnostics))
            return sampler;
        sampler.values.resize(output.count * output.components);
        readFloats(mDocument, source.output, sampler.values, mDiagnostics);
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
    void warnAboutTimes() {
        if (mMended.empty()) return;
        KeyRepairs all;
        for (KeyRepairs const& repairs : mRepairs) all += repairs;
        mDiagnostics.warn("{}: {} '{}': the times of channels {} do not grow from 0 on: {}", mFile, mPath,
                          mSource.name.substr(0, 80), listOfNumbers(mMended), toString(all));
    }

    GltfDocument const& mDocument;
    GltfScene const& mScene;
    GltfAnimation const& mSource;
    std::string_view mFile;
    std::string mPath;
    uint64_t& mNumbersLeft;
    Diagnostics& mDiagnostics;
    AnimationData mData;
    std::vector<KeyRepairs> mRepairs; // parallel to mData.samplers
    std::vector<size_t> mMended;      // channels of these
    std::map<std::tuple<uint32_t, AnimationPath, uint32_t>, std::optional<uint32_t>> mKnown;
};

} // namespace

std::vector<AnimationData> readAnimations(GltfDocument const& document, GltfScene const& scene, std::string_view file,
                                          Diagnostics& diagnostics) {
    std::vector<AnimationData> animations;
    uint64_t numbersLeft = kMaxNumbers;
    for (uint32_t i = 0; i < document.animations.size() && diagnostics.ok(); ++i) {
        animations.push_back(Reader(document, scene, i, file, numbersLeft, diagnostics).read());
    }
    return animations;
}

} // namespace filament::assets
