// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/LastFrame.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::prepare {
namespace {

// How many frames are in the image while something moves: enough to smooth edges, and few enough that what each
// filtering of the history blurs, and each limit of its colours, is soon replaced.
constexpr float kAccumulatedInMotion = 4;
constexpr float kAccumulatedInTurn = 9; // of the camera alone
constexpr float kMostAccumulated = 255; // of a still image
constexpr uint32_t kJitters = 1024;

// A pixel of an enlarged image is the mean of the samples in it in the end. Until there are some, the filter is as
// wide as two pixels.
constexpr float kWidestRamp = 0.5f, kNarrowestRamp = 0.0625f;

/// Gives back what a quarter of would do.
template <class T>
void resizeAndShrink(std::vector<T>& values, size_t size) {
    constexpr size_t kFew = 4096;
    values.resize(size);
    if (values.capacity() > 4 * size + kFew) values.shrink_to_fit();
}

float rampOf(float accumulated) {
    return std::max(kWidestRamp / std::sqrt(std::max(accumulated, 1.0f)), kNarrowestRamp);
}

} // namespace

void LastFrame::keep(scene::SceneData const& scene, ViewInput const& view, FramePacket const& packet) {
    const ViewSpace space = makeViewSpace(view);
    const bool isFollowing = isAccumulatedBy(scene, packet.settings);
    const bool keepsFog =
            packet.demand.needs(Effect::VolumetricFog) && packet.settings.effects.fog.volumetricFrames > 1;
    const bool hasFog = hasFogOf(scene, packet.settings);
    mSeen = { view,
              packet.settings,
              scene.serial,
              space.clipFromWorld,
              space.cameraWorld,
              space.forward,
              packet.mainView().uniforms.time };
    const bool accumulates = packet.demand.needs(Effect::Taa);
    mJitters = accumulates ? ((isFollowing ? mJitters : 0) + 1) % kJitters : 0;
    mFogFrames = keepsFog ? (hasFog ? mFogFrames : 0) + 1 : 0;
    mIsExposed = packet.demand.needs(Effect::AutoExposure);
    mIsReflected = packet.demand.needs(Effect::Reflections);
    mAccumulated = accumulates ? 1 / packet.accumulation.weight : 0;
    mLevels.clear();
    if (view.lodPixels > 0) {
        mLevels.resize(scene.renderables.count());
        writeDrawnLevels(scene, packet.mainView(), mLevels);
    }
    mScene = 0; // until all places are kept: if memory runs out, none is known
    if (packet.settings.readsMotion(packet.mainView().counts)) keepPlaces(scene);
}

// Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences": multiples of the inverses of the plastic
// number and of its square. Any few that follow each other cover the pixel evenly; the first is in its middle.
float2 LastFrame::jitterPixels(scene::SceneData const& scene, FrameSettings const& settings) const {
    const double at = isAccumulatedBy(scene, settings) ? mJitters : 0;
    const double2 place = double2(0.75487766624669276, 0.56984029099805327) * at + 0.5;
    return float2(glm::fract(place) - 0.5);
}

bool LastFrame::isFollowedBy(scene::SceneData const& scene, FrameSettings const& settings) const {
    return mSeen && mSeen->scene == scene.serial && mSeen->settings.shownSize == settings.shownSize &&
           (mSeen->settings.band > 0) == (settings.band > 0);
}

/// By one whose history has the same size, too.
bool LastFrame::isAccumulatedBy(scene::SceneData const& scene, FrameSettings const& settings) const {
    const auto accumulatedSize = [](FrameSettings const& of) { return of.upscalesOverFrames ? of.shownSize : of.size; };
    return isFollowedBy(scene, settings) && accumulatedSize(mSeen->settings) == accumulatedSize(settings);
}

/// Whether this frame shows what the last one did, as far as both see it.
bool LastFrame::isFixed(ViewInput const& view, FramePacket const& packet) const {
    ViewInput const& last = mSeen->view;
    FrameSettings const& settings = packet.settings;
    Effects lastEffects = mSeen->settings.effects;
    lastEffects.resolution = settings.effects.resolution; // how many samples there are does not change what they show
    const bool isSame = last.contents == view.contents && last.camera.position() == view.camera.position() &&
                        last.camera.exposure == view.camera.exposure && mSeen->settings.quality == settings.quality &&
                        lastEffects == settings.effects && last.visibleLayers == view.visibleLayers &&
                        last.lodPixels == view.lodPixels;
    if (!isSame || packet.motionView != kNowhere || packet.mainView().counts.fadingLevels > 0) return false;
    const bool isSameSection = last.section == view.section;
    const bool isSameTime = last.timeSeconds == view.timeSeconds && last.materialGlobals == view.materialGlobals;
    if (isSameTime && isSameSection) return true;
    const auto readsFrame = [&](DrawCall const& draw) {
        shader::MaterialPackage const& package = draw.material->material->package;
        return (package.readsFrame && !isSameTime) || (package.sectionPlanes && !isSameSection);
    };
    ViewPacket const& main = packet.mainView();
    return std::ranges::none_of(main.opaque, readsFrame) && std::ranges::none_of(main.blended, readsFrame);
}

Accumulation LastFrame::accumulation(scene::SceneData const& scene, ViewInput const& view,
                                     FramePacket const& packet) const {
    Accumulation accumulation{ .jitterPixels = jitterPixels(scene, packet.settings) };
    const bool isEnlarged = packet.settings.isUpscaledOverFrames();
    if (isEnlarged) accumulation.ramp = kWidestRamp;
    if (!isAccumulatedBy(scene, packet.settings)) return accumulation;
    accumulation.isFixed = isFixed(view, packet);
    const bool isStill = accumulation.isFixed && !packet.last.isElsewhere;
    const float most = isStill ? kMostAccumulated : accumulation.isFixed ? kAccumulatedInTurn : kAccumulatedInMotion;
    const float accumulated = std::min(mAccumulated, most);
    accumulation.weight = 1 / (1 + accumulated);
    if (isEnlarged && isStill) accumulation.ramp = rampOf(accumulated);
    return accumulation;
}

/// Whether the last frame left light in cells that this frame's lie in the order of.
bool LastFrame::hasFogOf(scene::SceneData const& scene, FrameSettings const& settings) const {
    if (mFogFrames == 0 || !isFollowedBy(scene, settings)) return false;
    Fog const &now = settings.effects.fog, &last = mSeen->settings.effects.fog;
    return mSeen->settings.size == settings.size && last.volumetricPixels == now.volumetricPixels &&
           last.volumetricSlices == now.volumetricSlices && last.volumetricMeters == now.volumetricMeters;
}

// Roberts 2018, as jitterPixels(), in three dimensions: multiples of the inverse powers of 1.2207, the root of
// x^4 = x + 1. Until there were as many frames as asked for, each lights more.
FogAccumulation LastFrame::fogAccumulation(scene::SceneData const& scene, ViewInput const& view,
                                           FrameSettings const& settings) const {
    constexpr uint32_t kPlaces = 1024;
    const uint32_t most = settings.effects.fog.volumetricFrames;
    if (most <= 1 || !hasFogOf(scene, settings)) return {};
    const double3 place = double3(0.81917251339616444, 0.67104360670378920, 0.54970047790197026) *
                                  static_cast<double>(mFogFrames % kPlaces) +
                          0.5;
    return { .place = float3(glm::fract(place)),
             .weight = 1.0f / static_cast<float>(std::min(mFogFrames + 1, most)),
             .exposure = view.camera.exposure.factor() / mSeen->view.camera.exposure.factor() };
}

/// Of what moved lately; the rest is where it was, or the scene saves where that is.
void LastFrame::keepPlacements(scene::Renderables const& renderables) {
    renderables.restPlaces.ask(renderables.count());
    const std::span<const scene::RestingBlocks::Word> words = renderables.blocks.words();
    mPass = renderables.blocks.pass();
    mRecent.resize(words.size());
    uint32_t count = 0;
    for (size_t i = 0; i < words.size(); ++i) {
        mRecent[i] = { words[i].recent(), count };
        count += static_cast<uint32_t>(std::popcount(mRecent[i].bits));
    }
    resizeAndShrink(mRenderables, count);
    resizeAndShrink(mPlacements, count);
    for (size_t i = 0; i < words.size(); ++i) {
        uint32_t to = mRecent[i].first;
        for (uint64_t left = mRecent[i].bits; left != 0; left &= left - 1, ++to) {
            const auto at = static_cast<uint32_t>(i * 64) + static_cast<uint32_t>(std::countr_zero(left));
            mRenderables[to] = renderables.index.handleAt(at);
            mPlacements[to] = renderables.placement[at];
        }
    }
}

void LastFrame::keepPlaces(scene::SceneData const& scene) {
    keepPlacements(scene.renderables);
    const auto deformations = scene.deformations.all();
    mDeformed.resize(deformations.size());
    for (size_t i = 0; i < deformations.size(); ++i) {
        mDeformed[i].renderable = deformations[i].renderable;
        mDeformed[i].skin = deformations[i].skin;
        mDeformed[i].weights = deformations[i].weights;
    }
    const auto skins = scene.deformations.skins();
    mBones.resize(skins.size());
    for (size_t i = 0; i < skins.size(); ++i) mBones[i] = skins[i].bones;
    mScene = scene.serial;
}

LastView LastFrame::seenFrom(ViewSpace const& space, ViewInput const& view, float4 const& time) const {
    const Seen last = mSeen.value_or(Seen{ view, {}, 0, space.clipFromWorld, space.cameraWorld, space.forward, time });
    const double3 moved = space.cameraWorld - last.cameraWorld;
    const double along = dot(double3(last.forward), moved);
    // Shaders have positions relative to the camera of this frame: the matrix of the last one first moves them to its
    // own. The difference of the places is taken in double precision, for worlds much larger than a step of a float.
    return { .clipFromWorld = float4x4(glm::translate(double4x4(last.clipFromWorld), moved)),
             .alongView = float4(last.forward, static_cast<float>(along)),
             .time = last.time,
             .isExposed = mIsExposed,
             .isReflected = mIsReflected && last.view.size == view.size,
             .secondsSince = static_cast<float>(std::max(view.timeSeconds - last.view.timeSeconds, 0.0)),
             .isElsewhere = last.clipFromWorld != space.clipFromWorld || moved != double3(0.0) };
}

scene::Placement const* LastFrame::placement(scene::SceneData const& scene, uint32_t at) const {
    scene::Renderables const& renderables = scene.renderables;
    if (mScene != scene.serial || renderables.blocks.pass() > mPass + 1) return nullptr;
    const uint64_t bit = uint64_t{ 1 } << at % 64;
    const Recent recent = at / 64 < mRecent.size() ? mRecent[at / 64] : Recent{};
    if (recent.bits & bit) {
        const uint32_t kept = recent.first + static_cast<uint32_t>(std::popcount(recent.bits & (bit - 1)));
        // Removing a renderable may move another one to its position, so that only the handle says what was there.
        return mRenderables[kept] == renderables.index.handleAt(at) ? &mPlacements[kept] : nullptr;
    }
    // It was not new then, and at rest.
    scene::RestingBlocks::Word const& now = renderables.blocks.words()[at / 64];
    if ((now.added | now.addedBefore) & bit) return nullptr;
    return now.moving() & bit ? renderables.restPlaces.find(at) : &renderables.placement[at];
}

std::optional<LastDeformation> LastFrame::deformation(scene::SceneData const& scene, uint32_t slot) const {
    if (mScene != scene.serial || slot >= mDeformed.size()) return std::nullopt;
    scene::Deformation const& now = scene.deformations.all()[slot];
    Deformed const& last = mDeformed[slot];
    if (last.renderable != now.renderable || last.skin != now.skin) return std::nullopt;
    LastDeformation found{ .weights = last.weights };
    if (now.skin) found.bones = mBones[now.skin.index()];
    // A skin of the same handle may have other bones by now.
    if (now.skin && found.bones.size() != scene.deformations.skin(now.skin).bones.size()) return std::nullopt;
    return found;
}

} // namespace filament_core::prepare
