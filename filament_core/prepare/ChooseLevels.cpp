// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ChooseLevels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::prepare {
namespace {

constexpr uint32_t kNotDrawn = ~0u;

DrawnLevel const* findDrawn(scene::SceneData const& scene, std::span<const DrawnLevel> drawn, uint32_t at) {
    const bool isKnown =
            at < drawn.size() && drawn[at].renderable && drawn[at].renderable == scene.renderables.index.handleAt(at);
    return isKnown ? &drawn[at] : nullptr;
}

/// What is drawn as it is, where its vertices are: of the parts of a mesh that fade, one leaves its depth by another
/// material, and both are seen where they have that depth.
bool mayFade(scene::Drawables const& drawables, uint32_t drawable) {
    using scene::Drawables;
    constexpr uint32_t kOthers = Drawables::kBlendedOrder | Drawables::kNoDepthWriteOrder |
                                 Drawables::kNoDepthTestOrder | Drawables::kReadsSceneColorOrder |
                                 Drawables::kStencilWriteOrder;
    scene::Drawable const& drawn = drawables[drawable];
    shader::MaterialPackage const& package = drawn.material->material->package;
    scene::InstanceRaster const& raster = drawn.material->raster;
    const bool hasSides = raster.cullingDisabled || raster.culling == shader::Culling::None ||
                          raster.culling == shader::Culling::Back;
    return (drawables.use(drawable).order & kOthers) == 0 && !raster.stencil && raster.colorWrite && hasSides &&
           package.blending == shader::Blending::Opaque && !package.depthReadsParameters &&
           !package.findVariant(shader::kVariantMotion);
}

/// The square of the tangent of the angle between the axis of a perspective view and its farthest corner.
float squaredCornerTangent(float4x4 const& clip) {
    float largest = 0;
    for (const float x : { -1.0f, 1.0f }) {
        for (const float y : { -1.0f, 1.0f }) {
            const float2 corner((x + clip[2][0]) / clip[0][0], (y + clip[2][1]) / clip[1][1]);
            largest = std::max(largest, glm::dot(corner, corner));
        }
    }
    return largest;
}

} // namespace

float largestStretch(float3 row0, float3 row1, float3 row2) {
    const float3x3 byColumns = glm::transpose(float3x3(row0, row1, row2));
    const float3x3 squared = glm::transpose(byColumns) * byColumns;
    float largest = 0;
    for (int i = 0; i < 3; ++i)
        largest = std::max(largest, std::abs(squared[i][0]) + std::abs(squared[i][1]) + std::abs(squared[i][2]));
    return std::sqrt(largest);
}

uint32_t levelOf(scene::Drawables const& drawables, uint32_t finest, uint32_t drawable) {
    uint32_t level = 0;
    for (; finest != drawable && finest != scene::kNoLevel; finest = drawables.level(finest).coarser) ++level;
    return level;
}

void writeDrawnLevels(scene::SceneData const& scene, ViewPacket const& view, std::span<DrawnLevel> levels) {
    scene::Renderables const& renderables = scene.renderables;
    for (SortItem const& item : view.objects.order) {
        const uint32_t finest = renderables.drawable[item.renderable];
        const auto level = static_cast<uint16_t>(levelOf(renderables.drawables, finest, drawableOf(item.draw)));
        const LevelFade fade = fadeOf(item.draw);
        DrawnLevel& drawn = levels[item.renderable];
        if (fade < 0) {
            drawn.vanishing = level; // the other part of this renderable says the rest
            continue;
        }
        drawn.renderable = renderables.index.handleAt(item.renderable);
        drawn.level = level;
        drawn.fade = static_cast<uint8_t>(fade);
    }
}

LevelChoice::LevelChoice(scene::SceneData const& scene, ViewInput const& view, std::span<const DrawnLevel> last,
                         bool fades)
        : mScene(&scene), mLast(last), mPixels(view.lodPixels), mFades(fades) {
    if (!isOn()) return;
    // Jitter would change the limit from frame to frame, and with it the levels near it. The size is that of the image
    // as it is shown: a guard band and a reduced resolution change no level.
    ViewInput still = view;
    still.jitterPixels = float2(0);
    const ViewSpace space = makeViewSpace(still);
    float4x4 const& clip = space.clipFromView;
    const float2 size = float2(view.size) * float2(view.shown()) / float2(view.inside());
    mForward = space.forward;
    mIsParallel = clip[3][3] != 0;
    mPerMeter = std::max(std::abs(clip[0][0]) * size.x, std::abs(clip[1][1]) * size.y) / 2;
    if (!mIsParallel) mPerMeter *= std::sqrt(1 + squaredCornerTangent(clip));
}

LevelChoice LevelChoice::ofShadowMap(scene::SceneData const& scene, ViewInput const& map,
                                     std::span<const DrawnLevel> main) {
    LevelChoice choice(scene, map);
    choice.mFinest = main;
    return choice;
}

float LevelChoice::pixelsPerMeter(float3 center, float3 halfExtent) const {
    if (mIsParallel) return mPerMeter;
    const float nearest = glm::dot(mForward, center) - glm::dot(glm::abs(mForward), halfExtent);
    return nearest > 0 ? mPerMeter / nearest : std::numeric_limits<float>::infinity();
}

float LevelChoice::scaleOf(uint32_t at) const {
    scene::Renderables const& renderables = mScene->renderables;
    auto const& rows = renderables.placement[at].rows;
    const float own = largestStretch(rows[0], rows[1], rows[2]);
    const uint32_t slot = scene::deformationAt(renderables, at);
    if (slot == scene::kNotDeformed) return own;
    const Skin skin = mScene->deformations.all()[slot].skin;
    if (!skin) return own;
    float largest = 0;
    for (shader::BoneData const& bone : mScene->deformations.skin(skin).bones)
        largest = std::max(largest, largestStretch(float3(bone.row0), float3(bone.row1), float3(bone.row2)));
    return own * largest;
}

uint32_t LevelChoice::choose(uint32_t at, uint32_t finest, float3 center, float3 halfExtent) const {
    scene::Renderables const& renderables = mScene->renderables;
    scene::Drawables::Level level = renderables.drawables.level(finest);
    // Without bounds there is no distance by which an error could be judged.
    const bool hasBounds = (renderables.flags[at] & scene::kCulled) != 0;
    if (level.coarser == scene::kNoLevel || !hasBounds) return finest;
    DrawnLevel const *const before = findDrawn(*mScene, mLast, at), *const inView = findDrawn(*mScene, mFinest, at);
    uint32_t chosen = finest;
    if (before && before->isFading() && before->fade + 1u < kFadeFrames) {
        for (uint32_t left = before->level; left > 0 && level.coarser != scene::kNoLevel; --left)
            level = renderables.drawables.level(chosen = level.coarser);
        return chosen;
    }
    const float perMeter = pixelsPerMeter(center, halfExtent) * scaleOf(at);
    const uint32_t last = before ? before->level : kNotDrawn, least = inView ? inView->coarsest() : 0;
    for (uint32_t number = 1; level.coarser != scene::kNoLevel; ++number) {
        const float limit = number > last ? mPixels * kSteady : mPixels;
        const uint32_t coarser = level.coarser;
        level = renderables.drawables.level(coarser);
        // The negation also stops at a camera inside of the box, where an error of 0 times infinity is not a number.
        // Errors grow from level to level, so that no coarser level can fit once one does not.
        if (number > least && !(level.errorMeters * perMeter <= limit)) break;
        chosen = coarser;
    }
    return chosen;
}

LevelChoice::Vanishing LevelChoice::vanishing(uint32_t at, uint32_t finest, uint32_t chosen) const {
    scene::Drawables const& drawables = mScene->renderables.drawables;
    DrawnLevel const* const before = mFades ? findDrawn(*mScene, mLast, at) : nullptr;
    if (!before) return {};
    const bool continues = before->isFading() && before->fade + 1u < kFadeFrames;
    uint32_t drawable = finest;
    for (uint32_t left = continues ? before->vanishing : before->level; left > 0 && drawable != scene::kNoLevel; --left)
        drawable = drawables.level(drawable).coarser;
    if (drawable == chosen || drawable == scene::kNoLevel || !mayFade(drawables, finest)) return {};
    return { drawable, static_cast<LevelFade>(continues ? before->fade + 1 : 1) };
}

} // namespace filament_core::prepare
