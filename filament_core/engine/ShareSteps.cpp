// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/ShareSteps.h"

#include "base/Assert.h"
#include "base/OutOfMemory.h"
#include "base/math/Half.h"
#include "filament_core/engine/ShareEffects.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace filament_core::engine {
namespace {

double doubleFromHalf(uint16_t bits) {
    const bool isFinite = (bits & 0x7C00u) != 0x7C00u;
    if (isFinite) return static_cast<double>(floatFromHalf(bits));
    if ((bits & 0x03FFu) != 0) return std::numeric_limits<double>::quiet_NaN();
    return (bits & 0x8000u) != 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

bool hasIndirectLight(scene::SceneData const& scene) {
    return scene.indirectLight.specular || !scene.probes.records.empty() || !scene.grids.records.empty();
}

class ShareStepList {
public:
    ShareStepList(Scene const& scene, View const& view)
            : mScene(scene), mData(scene.impl().upToDate()), mView(view), mDrawn(view) {}

    /// Leaves out effects, which come later.
    template <class Predicate>
    void leaveOut(Predicate const& isLeftOut) {
        for (ShareEffect const& effect : shareEffects())
            if (effect.isIn(mView) && isLeftOut(effect)) effect.leaveOut(mDrawn);
    }

    void addLights(std::span<const LightGroup> groups) {
        mDark.assign(mData.lights.records.size(), 1);
        mDarkEnvironment = hasIndirectLight(mData);
        add({ .kind = ShareKind::Emission, .name = "emission" });
        if (std::exchange(mDarkEnvironment, false)) add({ .kind = ShareKind::Environment, .name = "environment" });
        for (LightGroup const& group : groups) {
            for (const Light light : group.lights) mDark[mData.lights.index.at(light)] = 0;
            add({ .kind = ShareKind::Lights, .name = group.name, .lights = group.lights });
        }
        for (uint32_t i = 0; i < mDark.size(); ++i) {
            if (std::exchange(mDark[i], uint8_t{ 0 }) == 0) continue;
            const Light light = mData.lights.index.handleAt(i);
            add({ .kind = ShareKind::Lights, .name = nameOf(light, i), .lights = { light } });
        }
    }

    void addAllLight() { add({ .kind = ShareKind::Lights, .name = "light" }); }

    void addEffects() {
        for (ShareEffect const& effect : shareEffects()) {
            if (!effect.isIn(mView)) continue;
            mDrawn = mView; // with those up to this one
            for (ShareEffect const& later :
                 shareEffects().subspan(static_cast<size_t>(&effect - shareEffects().data()) + 1))
                later.leaveOut(mDrawn);
            add({ .kind = ShareKind::Effect, .name = std::string(effect.name) });
        }
    }

    /// All that were left out at once.
    void addRest() {
        if (mDrawn.quality == mView.quality && mDrawn.effects == mView.effects && mDrawn.samples == mView.samples)
            return;
        mDrawn = mView;
        add({ .kind = ShareKind::Effect, .name = "effects" });
    }

    std::vector<ShareStep> take() { return std::move(mSteps); }

private:
    std::string nameOf(Light light, uint32_t record) const {
        std::string name = "light" + std::to_string(record);
        const Node node = mScene.node(light);
        if (node && !mScene.name(node).empty()) name += ' ' + mScene.name(node);
        return name;
    }

    void add(ShareTerm term) {
        mSteps.push_back({ .term = std::move(term), .view = mDrawn, .darkEnvironment = mDarkEnvironment });
        if (std::ranges::count(mDark, uint8_t{ 1 }) > 0) mSteps.back().dark = mDark;
    }

    Scene const& mScene;
    scene::SceneData const& mData;
    View const& mView;
    View mDrawn;
    std::vector<uint8_t> mDark;
    bool mDarkEnvironment = false;
    std::vector<ShareStep> mSteps;
};

/// What renderers draw of the scene meanwhile.
class DarkScene {
public:
    DarkScene(Scene const& scene, ShareStep const& step) : mImpl(scene.impl()) {
        mImpl.dark = { step.dark, step.darkEnvironment };
    }
    ~DarkScene() { mImpl.dark = {}; }
    DarkScene(DarkScene const&) = delete;
    DarkScene& operator=(DarkScene const&) = delete;

private:
    Scene::Impl const& mImpl;
};

} // namespace

std::vector<ShareStep> shareSteps(Scene const& scene, View const& view, ShareOptions const& options) {
    FILAMENT_ASSERT(view.debugView == DebugView::None && view.aov == Aov::None,
                    "shares are of a picture: View::debugView and aov are None");
    FILAMENT_ASSERT(options.frames >= 1 && options.frames <= ShareOptions::kMostFrames,
                    "shares are of 1 to 1024 frames");
    View whole = view;
    whole.viewport.reset();
    whole.effects.resolution.dynamic = false;
    ShareStepList steps(scene, whole);
    if (options.terms == ShareTerms::Lights) {
        steps.leaveOut([&](ShareEffect const& effect) { return !effect.addsUp(whole); });
        steps.addLights(options.groups);
        steps.addRest();
        return steps.take();
    }
    steps.leaveOut([](ShareEffect const&) { return true; });
    if (options.terms == ShareTerms::All)
        steps.addLights(options.groups);
    else
        steps.addAllLight();
    steps.addEffects();
    return steps.take();
}

Result<void> drawShares(Engine& engine, Scene const& scene, std::span<const ShareStep> steps, uint32_t frames,
                        std::function<void(Image&&)> const& take) {
    const uint2 size = steps.front().view.size;
    const Owned<Texture> light = engine.own(engine.create(TextureDesc{
            .format = Format::RGBA16F, .width = size.x, .height = size.y, .renderable = true, .name = "shares" }));
    if (!light.get()) return outOfMemory("render shares: no texture");
    const Owned<RenderTarget> target = engine.own(engine.create(RenderTargetDesc{ .color = light }));
    for (ShareStep const& step : steps) {
        const DarkScene dark(scene, step);
        Renderer renderer(engine); // each begins without a history
        for (uint32_t frame = 0; frame < frames; ++frame) renderer.render(scene, step.view, target);
        Result<Image> image = renderer.waitPixels(renderer.readPixels(target));
        if (!image) return image.error();
        take(std::move(*image));
    }
    return {};
}

std::array<uint16_t, 4> halvesAt(Image const& image, size_t pixel) {
    std::array<uint16_t, 4> halves{};
    std::memcpy(halves.data(), image.pixels.data() + pixel * sizeof(halves), sizeof(halves));
    return halves;
}

double4 shareOf(std::array<uint16_t, 4> const& before, std::array<uint16_t, 4> const& after) {
    double4 share{ 0 };
    for (int i = 0; i < 4; ++i) {
        const auto channel = static_cast<size_t>(i);
        if (before[channel] != after[channel])
            share[i] = doubleFromHalf(after[channel]) - doubleFromHalf(before[channel]);
    }
    return share;
}

} // namespace filament_core::engine
