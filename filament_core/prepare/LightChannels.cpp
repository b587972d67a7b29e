// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/LightChannels.h"

#include "filament_core/prepare/Froxels.h"
#include "filament_core/prepare/PrefetchDraws.h"
#include "filament_core/prepare/ViewConstants.h"

#include <algorithm>
#include <array>
#include <bitset>

namespace filament_core::prepare {
namespace {

constexpr size_t kMasks = 256;

bool isLit(DrawCall const& draw) { return draw.material->material->isLit(); }

bool meetsLight(DrawCall const& draw) { return isLit(draw) || draw.material->material->package.shadowMultiplier; }

template <class F>
void forEachLit(ViewPacket const& view, F&& function) {
    for (std::span<const DrawCall> draws : { view.opaque, view.blended }) {
        for (size_t i = 0; i < draws.size(); ++i) {
            prefetchDraw(draws, i);
            if (meetsLight(draws[i])) function(draws[i]);
        }
    }
}

void removeSun(shader::FrameUniforms& frame) {
    frame.sunDirection = float4(0, 1, 0, 0);
    frame.sunIlluminance = float4(0);
}

/// The masks of lights that a mask of renderables shares a channel with, among those that occur.
std::bitset<kMasks> shining(std::bitset<kMasks> const& lightMasks, uint8_t channels) {
    std::bitset<kMasks> shared;
    for (size_t mask = 0; mask < kMasks; ++mask) shared[mask] = lightMasks[mask] && (mask & channels) != 0;
    return shared;
}

class ChannelSeparation {
public:
    ChannelSeparation(jobs::JobSystem& jobs, Arena& arena, scene::Lights const& lights, ViewInput const& input,
                      PreparedView& view)
            : mJobs(jobs), mArena(arena), mLights(lights), mInput(input), mView(view),
              mListOf(arena.array<uint16_t>(kMasks)) {}

    void separate() {
        std::bitset<kMasks> lightMasks, drawMasks;
        // Of 256 possible masks a scene has few. Lists are made for sets of lights, not for masks of draws, so that
        // draws on different channels with the same lights have one list.
        for (const uint32_t record : mView.lightRecords) lightMasks.set(mLights.records[record].channels);
        if (mView.sunRecord) lightMasks.set(mLights.records[*mView.sunRecord].channels);
        forEachLit(mView.packet, [&](DrawCall const& draw) { drawMasks.set(draw.properties.lightChannels); });
        for (size_t mask = 0; mask < kMasks; ++mask) {
            if (drawMasks[mask]) place(shining(lightMasks, static_cast<uint8_t>(mask)), lightMasks, mask);
        }
        if (mCount == 0) return;
        const auto lists = mArena.arrayForOverwrite<ChannelLights>(mCount);
        for (size_t i = 0; i < mCount; ++i) lists[i] = listOf(mShining[i]);
        mView.packet.channels = { lists, mListOf };
    }

private:
    /// Masks on which the same lights shine share a list.
    void place(std::bitset<kMasks> const& shared, std::bitset<kMasks> const& all, size_t mask) {
        if (shared == all) return; // the list of the view
        const auto end = mShining.begin() + static_cast<std::ptrdiff_t>(mCount);
        const auto known = std::find(mShining.begin(), end, shared);
        if (known == end) mShining[mCount++] = shared;
        mListOf[mask] = static_cast<uint16_t>(known - mShining.begin() + 1);
    }

    ChannelLights listOf(std::bitset<kMasks> const& shared) const {
        ViewPacket& packet = mView.packet;
        ChannelLights list{ .uniforms = packet.uniforms };
        list.hasSun = mView.sunRecord && shared[mLights.records[*mView.sunRecord].channels];
        if (!list.hasSun) removeSun(list.uniforms);
        const auto lights = mArena.arrayForOverwrite<shader::PunctualLight>(packet.lights.size());
        size_t count = 0;
        for (size_t i = 0; i < packet.lights.size(); ++i) {
            if (shared[mLights.records[mView.lightRecords[i]].channels]) lights[count++] = packet.lights[i];
        }
        list.lights = lights.first(count);
        list.uniforms.ambient.w = static_cast<float>(count);
        // The copied grid has the places of the view's lights, of which this list has only some.
        list.uniforms.froxelGrid = list.uniforms.froxelPlaces = float4(0);
        ViewCounts counts;
        list.froxels =
                assignLights(mJobs, mArena, makeViewSpace(mInput), mInput.size, list.lights, list.uniforms, counts);
        packet.counts.froxels += counts.froxels;
        packet.counts.froxelEntries += counts.froxelEntries;
        packet.counts.fullFroxels += counts.fullFroxels;
        packet.counts.lightsLeftOut += counts.lightsLeftOut;
        packet.counts.longestFroxel = std::max(packet.counts.longestFroxel, counts.longestFroxel);
        return list;
    }

    jobs::JobSystem& mJobs;
    Arena& mArena;
    scene::Lights const& mLights;
    ViewInput const& mInput;
    PreparedView& mView;
    std::span<uint16_t> mListOf;
    std::array<std::bitset<kMasks>, kMasks> mShining;
    size_t mCount = 0;
};

} // namespace

uint8_t ChannelLists::variantOf(DrawCall const& draw, uint8_t variant) const {
    const uint32_t at = of(draw.properties.lightChannels);
    if (at == 0) return variant;
    ChannelLights const& list = lists[at - 1];
    int kept = variant;
    if (!list.hasSun) kept &= ~shader::kVariantSun;
    if (list.lights.empty()) kept &= ~shader::kVariantPunctual;
    // Only the sun can darken what is not lit.
    const bool canDarken = isLit(draw) ? (kept & (shader::kVariantSun | shader::kVariantPunctual)) != 0 : list.hasSun;
    if (!canDarken) kept &= ~shader::kVariantShadowReceiver;
    return static_cast<uint8_t>(kept);
}

DrawnChannels channelsOf(ViewPacket const& view) {
    DrawnChannels channels;
    forEachLit(view, [&](DrawCall const& draw) {
        channels.any |= draw.properties.lightChannels;
        channels.inCommon &= draw.properties.lightChannels;
    });
    return channels;
}

void dropUnseenLights(Arena& arena, scene::Lights const& lights, uint8_t seen, PreparedView& view) {
    ViewPacket& packet = view.packet;
    const auto isSeen = [&](uint32_t record) { return (lights.records[record].channels & seen) != 0; };
    if (view.sunRecord && !isSeen(*view.sunRecord)) {
        view.sunRecord.reset();
        removeSun(packet.uniforms);
        packet.counts.sunsOfOtherChannels = packet.counts.suns;
        packet.counts.contactLights -= packet.uniforms.contactShadows.w > 0 ? 1 : 0;
        packet.uniforms.contactShadows.w = 0;
    }
    if (std::ranges::all_of(view.lightRecords, isSeen)) return;
    const auto kept = arena.arrayForOverwrite<shader::PunctualLight>(packet.lights.size());
    const auto records = arena.arrayForOverwrite<uint32_t>(packet.lights.size());
    uint32_t count = 0;
    for (size_t i = 0; i < packet.lights.size(); ++i) {
        if (!isSeen(view.lightRecords[i])) {
            scene::LightRecord const& unseen = lights.records[view.lightRecords[i]];
            packet.counts.areaLights -= unseen.isArea() ? 1 : 0;
            packet.counts.profiledLights -= unseen.profile ? 1 : 0;
            packet.counts.imagedLights -= unseen.image ? 1 : 0;
            packet.counts.contactLights -= unseen.contactShadows ? 1 : 0;
            continue;
        }
        kept[count] = packet.lights[i];
        records[count++] = view.lightRecords[i];
    }
    packet.lights = kept.first(count);
    view.lightRecords = records.first(count);
    packet.counts.lightsOfOtherChannels = packet.counts.lights - count;
    packet.counts.lights = count;
    packet.uniforms.ambient.w = static_cast<float>(count);
}

void separateChannels(jobs::JobSystem& jobs, Arena& arena, scene::Lights const& lights, ViewInput const& input,
                      PreparedView& view) {
    if (!view.hasChannels) return;
    ChannelSeparation(jobs, arena, lights, input, view).separate();
}

} // namespace filament_core::prepare
