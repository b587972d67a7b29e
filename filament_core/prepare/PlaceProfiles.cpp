// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PlaceProfiles.h"

#include <algorithm>
#include <bit>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;
using Table = std::span<const uint32_t>;

/// The tables that the lights of a view name, each once, and where they will lie.
class TableList {
public:
    TableList(Arena& arena, size_t most, uint32_t firstWord)
            : mTables(arena.arrayForOverwrite<Table>(most)), mPlaces(arena.arrayForOverwrite<uint32_t>(most)),
              mNext(firstWord), mEnd(firstWord + shader::kMaxProfileWords) {}

    /// The word where a table begins; 0: it does not fit.
    uint32_t placeOf(Table table) {
        const auto sameData = [&](Table known) { return known.data() == table.data(); };
        const auto known = std::ranges::find_if(mTables.first(mCount), sameData);
        const auto at = static_cast<size_t>(known - mTables.begin());
        if (at < mCount) return mPlaces[at];
        if (table.size() > mEnd - mNext) return 0;
        mTables[mCount] = table;
        mPlaces[mCount++] = mNext;
        mNext += static_cast<uint32_t>(table.size());
        return mPlaces[mCount - 1];
    }
    std::span<const Table> tables() const { return mTables.first(mCount); }

private:
    std::span<Table> mTables;
    std::span<uint32_t> mPlaces;
    size_t mCount = 0;
    uint32_t mNext, mEnd;
};

/// The axis of the profile's +X: across the direction, which stays where it is if a node with unequal scales turns the
/// two towards each other.
float3 sideOf(LightRecord const& light) {
    const float3 side = light.sideWorld - light.directionWorld * glm::dot(light.sideWorld, light.directionWorld);
    const float length = glm::length(side);
    return length > 1e-6f ? side / length : float3(0);
}

} // namespace

void placeProfiles(Arena& arena, scene::Lights const& lights, std::span<const uint32_t> records, ViewPacket& packet) {
    const uint32_t count = packet.counts.profiledLights;
    const std::span<shader::PunctualLight> placed = arena.copy(packet.lights);
    const auto words = arena.arrayForOverwrite<uint32_t>(size_t{ count } * shader::kProfiledLightWords);
    TableList tables(arena, count, static_cast<uint32_t>(words.size()));
    uint32_t profiled = 0;
    for (size_t i = 0; i < placed.size(); ++i) {
        LightRecord const& light = lights.records[records[i]];
        if (!light.profile) continue;
        const uint32_t place = tables.placeOf(*light.profile);
        const float3 side = sideOf(light);
        uint32_t* const own = words.subspan(size_t{ profiled++ } * shader::kProfiledLightWords).data();
        for (int axis = 0; axis < 3; ++axis) own[axis] = std::bit_cast<uint32_t>(side[axis]);
        own[3] = place;
        if (place == 0) {
            placed[i].colorIntensity = float4(0, 0, 0, placed[i].colorIntensity.w);
            ++packet.counts.profilesOverLimit;
        } else {
            // Counted from 1: to the shader, 0 is a light without a profile.
            placed[i].offset.w = static_cast<float>(profiled);
        }
    }
    packet.lights = placed;
    packet.profiles = { words, tables.tables() };
}

} // namespace filament_core::prepare
