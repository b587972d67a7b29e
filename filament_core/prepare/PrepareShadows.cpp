// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareShadows.h"

#include "base/Hash.h"
#include "filament_core/prepare/HashView.h"
#include "filament_core/prepare/HashWords.h"
#include "filament_core/prepare/HideOccluded.h"
#include "filament_core/prepare/PlaceShadowMaps.h"
#include "filament_core/prepare/ShadowReceivers.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;
using shader::kMaxShadowMaps;

constexpr uint32_t kSmallestPunctualMap = 64;
// Rounding of places and depths, as a part of the map's width and of the depth.
constexpr float kDepthBias = 1.0f / (1 << 20);
constexpr uint32_t kSunOfUniforms = ~0u; // for Caster::listed
constexpr uint32_t kMarginTexels = 16;   // of this many there is one around a map, into which a blur may reach

/// A light that may cast shadows in the view.
struct Caster {
    uint32_t record = 0; ///< of scene.lights
    uint32_t listed = 0; ///< of the lights of the main view, or kSunOfUniforms
    float pixels = 0;    ///< of the image that its reach covers, in one direction; of suns infinite
    uint32_t order = 0;  ///< among lights of equal reach
};

/// A map with something in it.
struct Candidate {
    FittedShadow fitted;
    ViewInput input;
    PreparedView prepared;
    uint32_t caster = 0; ///< of the casters
    uint32_t part = 0;   ///< cascade or face
    uint32_t channels = 1;
};

float3 relative(double3 const& world, ViewSpace const& space) { return float3(world - space.cameraWorld); }

/// Pixels across a sphere of the image; everything if the camera is inside; infinite for suns.
float pixelsOf(LightRecord const& light, ViewSpace const& space, uint2 size) {
    if (light.type == LightRecord::Type::Sun) return INFINITY;
    const auto all = static_cast<float>(std::max(size.x, size.y));
    const float range = light.rangeMeters, distance = glm::length(relative(light.positionWorld, space));
    const float perRadian = std::abs(space.clipFromView[1][1]) * static_cast<float>(size.y);
    if (range > 0 && space.clipFromView[3][3] != 0) return std::min(all, range * perRadian); // parallel: per metre
    if (range <= 0 || distance <= range) return all;
    return std::min(all, range / std::sqrt(distance * distance - range * range) * perRadian);
}

bool reaches(LightRecord const& light, ShadowReceivers const& receivers) {
    if (light.rangeMeters <= 0) return true;
    const double3 outside = glm::max(glm::abs(light.positionWorld - receivers.center()) - receivers.halfExtent(), 0.0);
    return glm::dot(outside, outside) <=
           static_cast<double>(light.rangeMeters) * static_cast<double>(light.rangeMeters);
}

uint32_t powerOfTwo(float pixels, uint32_t smallest, uint32_t largest) {
    const auto whole = static_cast<uint32_t>(std::clamp(pixels, 1.0f, 65536.0f));
    return std::clamp(std::bit_ceil(whole), smallest, largest);
}

class ShadowPreparation {
public:
    ShadowPreparation(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                      FrameSettings const& settings, PreparedView& main, ShadowAtlas const& held)
            : mJobs(jobs), mArena(arena), mScene(scene), mView(view), mSettings(settings), mMain(main), mHeld(held),
              mSpace(makeViewSpace(view)), mCandidates(arena.arrayForOverwrite<Candidate>(kMaxShadowMaps)) {}

    PreparedShadows prepare() {
        PreparedShadows out;
        mCounts.isOn = true;
        mCounts.isColorOn = mSettings.quality.coloredShadows;
        mCounts.isShapeOn = mSettings.quality.areaShadows == AreaShadows::Shape;
        mCounts.hasDepths = momentsFor(mSettings.quality.shadows) == ShadowMoments::None;
        mReceivers = findReceivers(mJobs, mArena, mScene, mMain.packet, mSpace, mSettings.quality.shadows);
        if (mSettings.lightsFog) addFog(mReceivers, mSpace, mSettings.effects.fog.volumetricMeters);
        mCounts.receivers = mReceivers.count;
        if (mView.lodPixels > 0) {
            mLevels = mArena.array<DrawnLevel>(mScene.renderables.count());
            writeDrawnLevels(mScene, mMain.packet, mLevels);
        }
        const std::span<const Caster> casters = findCasters();
        mCounts.lights = static_cast<uint32_t>(casters.size());
        if (mReceivers.count > 0) {
            for (uint32_t i = 0; i < casters.size(); ++i) addMaps(casters[i], i);
        }
        if (mCount > 0) place(casters, out);
        out.counts = mCounts;
        return out;
    }

private:
    /// The most important first: the sun, further suns, then by the pixels that they light; then in the list's order.
    std::span<const Caster> findCasters() {
        std::span<const uint32_t> listed = mMain.lightRecords;
        const auto casters = mArena.arrayForOverwrite<Caster>(listed.size() + 1);
        size_t count = 0;
        if (mMain.sunRecord && mScene.lights.records[*mMain.sunRecord].castsShadows)
            casters[count++] = { *mMain.sunRecord, kSunOfUniforms, INFINITY, 0 };
        for (uint32_t i = 0; i < listed.size(); ++i) {
            LightRecord const& light = mScene.lights.records[listed[i]];
            if (!light.castsShadows || mReceivers.count == 0 || !reaches(light, mReceivers)) continue;
            casters[count++] = { listed[i], i, pixelsOf(light, mSpace, mView.size), i + 1 };
        }
        const std::span<Caster> found = casters.first(count);
        std::ranges::sort(found, [](Caster const& a, Caster const& b) {
            return a.pixels != b.pixels ? a.pixels > b.pixels : a.order < b.order;
        });
        return found;
    }

    void addMaps(Caster const& caster, uint32_t index) {
        LightRecord const& light = mScene.lights.records[caster.record];
        if (light.type == LightRecord::Type::Sun) {
            addCascades(caster, light, index);
            return;
        }
        const uint32_t faces = takesCube(light) ? kCubeFaces : 1;
        for (uint32_t face = 0; face < faces; ++face) {
            if (faces == 1 || shinesThrough(light, face)) add(fitPunctual(light, face), caster, index, face);
        }
    }

    void addCascades(Caster const& caster, LightRecord const& light, uint32_t index) {
        const double3x3 axes = worldFromLight(double3(light.directionWorld));
        const LightSpaceBox extent = sceneInLightSpace(mJobs, mArena, mScene.renderables, axes, mView.visibleLayers);
        if (extent.isEmpty()) return;
        const uint32_t cascades = std::clamp<uint32_t>(mSettings.quality.shadowCascades, 1, kMaxCascades);
        const auto slices = splitDepth({ mReceivers.nearest, mReceivers.farthest }, cascades);
        bool coversScene = false;
        // A map that holds the whole scene serves all farther slices as well.
        for (uint32_t i = 0; i < cascades && !coversScene; ++i)
            add(fitCascade(mSpace, slices[i], axes, extent, coversScene), caster, index, i);
    }

    void add(FittedShadow const& fitted, Caster const& caster, uint32_t index, uint32_t part) {
        if (mCount == kMaxShadowMaps) {
            ++mCounts.mapsOverBudget;
            return;
        }
        ViewInput input{ .kind = ViewKind::Shadow,
                         .camera = fitted.camera,
                         .clipFromView = fitted.clipFromView,
                         .timeSeconds = mView.timeSeconds,
                         .materialGlobals = mView.materialGlobals,
                         .section = mView.section,
                         .quality = mView.quality,
                         .visibleLayers = mView.visibleLayers };
        input.quality.depthRange = DepthRange::Reversed;
        // What is beyond the reach of a lamp darkens nothing that the lamp lights. But means of depths contain it.
        if (momentsFor(mSettings.quality.shadows) == ShadowMoments::None && isPerspective(fitted))
            input.farMeters = mScene.lights.records[caster.record].rangeMeters;
        // At most a texel, which the offsets of receivers cover; of an image of one pixel, as the view has.
        input.lodPixels = std::min(mView.lodPixels, 1.0f) / static_cast<float>(sizeOf(caster));
        PreparedView prepared =
                prepareView(mJobs, mArena, mScene, input, mSettings, LevelChoice::ofShadowMap(mScene, input, mLevels));
        // Known only after culling: a map without casters takes no room in the atlas from others.
        if (prepared.packet.opaque.empty()) {
            ++mCounts.mapsWithoutCasters;
            return;
        }
        mCandidates[mCount++] = { fitted, input, prepared, index, part, channelsOf(prepared.packet) };
    }

    /// Three if something in a map transmits light.
    uint32_t channelsOf(ViewPacket const& map) const {
        const auto transmits = [](DrawCall const& draw) {
            return shader::transmitsLight(draw.material->material->package);
        };
        return mSettings.quality.coloredShadows && std::ranges::any_of(map.opaque, transmits) ? 3 : 1;
    }

    uint32_t sizeOf(Caster const& caster) const {
        const uint32_t largest = std::bit_floor(
                std::clamp<uint32_t>(mSettings.quality.shadowMapSize, kSmallestPunctualMap, kLargestShadowMap));
        LightRecord const& light = mScene.lights.records[caster.record];
        if (light.type == LightRecord::Type::Sun) return largest;
        // A face of a cube sees a quarter of the horizon, a spot about as much as its reach covers.
        return powerOfTwo(takesCube(light) ? caster.pixels / 2 : caster.pixels, kSmallestPunctualMap, largest);
    }

    uint64_t ownerOf(Caster const& caster, uint32_t part) const {
        return mScene.lights.index.handleAt(caster.record).number() << 8 | part;
    }

    void place(std::span<const Caster> casters, PreparedShadows& out) {
        const auto requests = mArena.arrayForOverwrite<ShadowMapRequest>(mCount);
        for (uint32_t i = 0; i < mCount; ++i) {
            Caster const& caster = casters[mCandidates[i].caster];
            const uint32_t side = mCandidates[i].channels > 1 ? 2 * sizeOf(caster) : sizeOf(caster);
            requests[i] = { ownerOf(caster, mCandidates[i].part), std::min(side, kLargestShadowMap) };
        }
        const uint64_t budget = uint64_t{ mSettings.quality.shadowAtlasMegabytes } << 20;
        const ShadowMoments moments = momentsFor(mSettings.quality.shadows);
        const PlacedShadowMaps placed = placeShadowMaps(mArena, requests, mHeld, atlasSizeForBytes(budget, moments));
        out.packet.atlasSize = placed.atlasSize;
        out.packet.moments = moments;
        out.packet.hasStencil = mSettings.cutsSlabs;
        out.packet.keepsAtlas =
                placed.atlasSize == mHeld.size && moments == mHeld.moments && out.packet.hasStencil == mHeld.hasStencil;
        const auto isLamps = [](Candidate const& candidate) { return isPerspective(candidate.fitted); };
        if (moments != ShadowMoments::None && std::ranges::any_of(mCandidates.first(mCount), isLamps))
            mWorld = sceneInLightSpace(mJobs, mArena, mScene.renderables, double3x3(1.0), mView.visibleLayers);
        // The lights of the view are spans of constants. The copies below get their maps, and replace them only if
        // there are any maps in the end.
        mLights = mArena.copy(mMain.packet.lights);
        mUniforms = mArena.make<shader::ShadowUniforms>();
        const auto maps = mArena.arrayForOverwrite<ShadowMapPacket>(mCount);
        const auto views = mArena.arrayForOverwrite<PreparedView>(mCount);
        uint32_t count = 0;
        for (uint32_t i = 0; i < mCount; ++i) {
            if (placed.tiles[i].size == 0) {
                ++mCounts.mapsOverBudget;
                continue;
            }
            Candidate& candidate = mCandidates[i];
            ViewPacket& view = candidate.prepared.packet;
            // The record comes before the hash, which reads its softness: moments are blurred by it when the map is
            // drawn.
            writeMap(count, casters[candidate.caster], candidate, placed.tiles[i]);
            maps[count] = { { requests[i].owner, hashOf(candidate, placed.tiles[i].size, mUniforms->maps[count]),
                              placed.tiles[i] },
                            candidate.channels };
            if (candidate.channels > 1) ++mCounts.coloredMaps;
            if (mScene.lights.records[casters[candidate.caster].record].isArea()) ++mCounts.areaMaps;
            if (!out.packet.keepsAtlas || !isHeld(maps[count].held)) {
                views[out.packet.drawn] = candidate.prepared;
                if (mSettings.cullsCasters && candidate.channels == 1)
                    hideCasters(candidate.input, placed.tiles[i], views[out.packet.drawn].packet);
                maps[count].view = out.packet.drawn++;
            }
            mCounts.casters += view.counts.visible;
            assign(casters[candidate.caster], candidate.part, count++);
        }
        finish(out, maps.first(count), views.first(out.packet.drawn));
    }

    void finish(PreparedShadows& out, std::span<const ShadowMapPacket> maps, std::span<const PreparedView> views) {
        out.packet.maps = maps;
        out.views = views;
        mCounts.maps = static_cast<uint32_t>(maps.size());
        mCounts.mapsDrawn = out.packet.drawn;
        if (maps.empty()) return;
        mMain.packet.lights = mLights;
        mMain.packet.variant |= shader::kVariantShadowReceiver;
        const auto size = static_cast<float>(out.packet.atlasSize);
        mUniforms->atlas = float4(1 / size, size, 0, 0);
        out.packet.uniforms = mUniforms;
    }

    /// After the hash, so that what is hidden neither changes which maps are kept nor is looked for in those.
    void hideCasters(ViewInput input, ShadowTile tile, ViewPacket& map) {
        input.size = uint2(tile.size);
        hideOccluded(mJobs, mArena, mScene.renderables, makeViewSpace(input), input, map);
    }

    uint64_t hashOf(Candidate const& candidate, uint32_t size, shader::ShadowMapRecord const& map) const {
        const uint64_t depths = hashShadowView(mScene, candidate.prepared.packet, size, candidate.channels > 1);
        if (momentsFor(mSettings.quality.shadows) == ShadowMoments::None) return depths;
        return hashWords(depths, std::bit_cast<uint32_t>(map.softness.z), std::bit_cast<uint32_t>(map.softness.w));
    }

    bool isHeld(HeldShadowMap const& map) const {
        return std::ranges::any_of(mHeld.maps, [&](HeldShadowMap const& held) {
            return held.owner == map.owner && held.contents == map.contents && held.tile == map.tile;
        });
    }

    void writeMap(uint32_t at, Caster const& caster, Candidate const& candidate, ShadowTile whole) const {
        FittedShadow const& fitted = candidate.fitted;
        const ShadowTile tile = channelTile(whole, candidate.channels, 0);
        shader::ShadowMapRecord& map = mUniforms->maps[at];
        map.atlasFromWorld = atlasFromWorld(fitted, mSpace.cameraWorld, tile.x, tile.y, tile.size);
        map.tile = float4(tile.x, tile.y, tile.x + tile.size, tile.y + tile.size);
        const auto texels = static_cast<float>(tile.size);
        const float ofWidth = fitted.depthMeters > 0 ? fitted.widthMeters / fitted.depthMeters : 0;
        map.texel =
                float4(fitted.widthMeters / texels, fitted.widthPerMeter / texels, kDepthBias * ofWidth, kDepthBias);
        const float penumbra = texels * penumbraOfDepth(fitted, mScene.lights.records[caster.record].sourceRadius);
        map.softness = float4(penumbra, candidate.channels, nearOverFar(fitted, mWorld), blurOf(tile.size));
    }

    /// Of moments; must not reach beyond a map's margin.
    float blurOf(uint32_t size) const {
        if (momentsFor(mSettings.quality.shadows) == ShadowMoments::None) return 0;
        const uint32_t margin = size / kMarginTexels;
        return static_cast<float>(std::min<uint32_t>(mSettings.quality.shadowBlurTexels, margin > 2 ? margin - 2 : 0));
    }

    /// Maps of a light are neighbours; cascades and a cube's faces without casters are left out.
    void assign(Caster const& caster, uint32_t part, uint32_t map) {
        if (caster.listed == kSunOfUniforms) {
            if (mUniforms->sun.y == 0) mUniforms->sun.x = static_cast<float>(map);
            mUniforms->sun.y += 1;
            return;
        }
        float4& light = mLights[caster.listed].offset;
        if (light.y == 0) {
            light.y = static_cast<float>(map + 1);
            if (takesCube(mScene.lights.records[caster.record])) light.z += static_cast<float>(1u << kCubeFaces);
        }
        // A set of bits, added one by one; a float holds all integers up to 2^24.
        light.z += static_cast<float>(1u << part);
    }

    jobs::JobSystem& mJobs;
    Arena& mArena;
    scene::SceneData const& mScene;
    ViewInput const& mView;
    FrameSettings const& mSettings;
    PreparedView& mMain;
    ShadowAtlas const& mHeld;
    const ViewSpace mSpace;
    ShadowReceivers mReceivers;
    LightSpaceBox mWorld;          ///< everything, in the world; for moments of points and spots only
    std::span<DrawnLevel> mLevels; ///< of the main view; none: the finest are drawn
    std::span<Candidate> mCandidates;
    uint32_t mCount = 0;
    std::span<shader::PunctualLight> mLights;
    shader::ShadowUniforms* mUniforms = nullptr;
    ShadowCounts mCounts;
};

} // namespace

PreparedShadows prepareShadows(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                               ViewInput const& view, FrameSettings const& settings, PreparedView& main,
                               ShadowAtlas const& held) {
    if (settings.quality.shadows == ShadowFilter::Off) return {};
    return ShadowPreparation(jobs, arena, scene, view, settings, main, held).prepare();
}

} // namespace filament_core::prepare
