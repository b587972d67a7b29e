// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareMotion.h"

#include "filament_core/prepare/DeformationData.h"

#include <algorithm>
#include <cstring>

namespace filament_core::prepare {
namespace {

using scene::Deformation;
using scene::Placement;
using shader::VertexDomain;

bool isEqual(Placement const& a, Placement const& b) { return std::memcmp(&a, &b, sizeof(Placement)) == 0; }

bool isDeformedAlike(scene::SceneData const& scene, uint32_t slot, LastDeformation const& last) {
    Deformation const& now = scene.deformations.all()[slot];
    if (!std::ranges::equal(now.weights, last.weights)) return false;
    if (!now.skin) return true;
    std::vector<shader::BoneData> const& bones = scene.deformations.skin(now.skin).bones;
    return std::memcmp(bones.data(), last.bones.data(), bones.size() * sizeof(shader::BoneData)) == 0;
}

/// What the objects of a frame are compared with.
struct Moment {
    scene::SceneData const& scene;
    LastFrame const& last;
    bool isTimePassed, isCameraElsewhere;
};

/// Of an object whose last place is known.
bool hasMoved(Moment const& moment, DrawCall const& draw, uint32_t deformation, Placement const& now,
              Placement const& last) {
    shader::MaterialPackage const& package = draw.material->material->package;
    const bool isDeformed = deformation != scene::kNotDeformed;
    const auto deformed = isDeformed ? moment.last.deformation(moment.scene, deformation) : std::nullopt;
    // Without its last pose an object has no known motion. Its pixels are reprojected as if it stood still.
    if (isDeformed && !deformed) return false;
    if (package.depthReadsParameters && package.readsFrame && moment.isTimePassed) return true;
    switch (package.vertexDomain) {
    case VertexDomain::World:
        return false;
    case VertexDomain::View:
    case VertexDomain::Device:
        return moment.isCameraElsewhere;
    case VertexDomain::Object:
        break;
    }
    return !isEqual(now, last) || (isDeformed && !isDeformedAlike(moment.scene, deformation, *deformed));
}

/// Two records an object. What shares a draw in the image shares one here, too.
class MotionList {
public:
    MotionList(Arena& arena, size_t most, bool deforms)
            : mDraws(arena.arrayForOverwrite<DrawCall>(most)), mOrder(arena.arrayForOverwrite<SortItem>(most * 2)),
              mPlacements(arena.arrayForOverwrite<Placement>(most * 2)),
              mSlots(arena.arrayForOverwrite<uint32_t>(deforms ? most : 0)),
              mDeformations(arena.arrayForOverwrite<uint32_t>(deforms ? most * 2 : 0)) {}

    /// `deformation`: of this object of the draw.
    void add(DrawCall const& of, uint32_t deformation, Placement const& now, Placement const& last) {
        const auto at = static_cast<uint32_t>(mCount * 2);
        mPlacements[at] = now;
        mPlacements[at + 1] = last;
        for (const uint32_t record : { at, at + 1 }) mOrder[record] = { .renderable = record };
        addTo(of, deformation, at);
        ++mCount;
        if (mDeformations.empty()) return;
        mDeformations[at] = mDeformations[at + 1] = deformation;
        if (deformation != scene::kNotDeformed) mSlots[mDeformed++] = deformation;
    }

    std::span<const DrawCall> draws() const { return mDraws.first(mDrawCount); }
    uint32_t count() const { return static_cast<uint32_t>(mCount); }
    std::span<const uint32_t> slots() const { return mSlots.first(mDeformed); }
    ObjectList objects(double3 const& camera) const {
        return { mOrder.first(mCount * 2), mPlacements, camera, mDeformations, {}, true };
    }

private:
    void addTo(DrawCall const& of, uint32_t deformation, uint32_t at) {
        if (mLast == &of && at % shader::kObjectsPerWindow != 0) {
            ++mDraws[mDrawCount - 1].instanceCount;
            return;
        }
        mLast = &of;
        DrawCall& draw = mDraws[mDrawCount++] = of;
        draw.fade = 0; // wherever either level is seen, it has the depth that is known
        draw.firstObject = at;
        draw.instanceCount = 1;
        draw.deformation = deformation;
    }

    std::span<DrawCall> mDraws;
    std::span<SortItem> mOrder;
    std::span<Placement> mPlacements;
    std::span<uint32_t> mSlots;
    std::span<uint32_t> mDeformations; // by record
    DrawCall const* mLast = nullptr;   // of the image: what the last of mDraws is made of
    size_t mCount = 0, mDrawCount = 0, mDeformed = 0;
};
static_assert(shader::kObjectsPerWindow % 2 == 0, "both records of an object lie in one window");

size_t countObjects(std::span<const DrawCall> draws) {
    size_t count = 0;
    for (DrawCall const& draw : draws) count += draw.instanceCount;
    return count;
}

} // namespace

PreparedMotion prepareMotion(Arena& arena, scene::SceneData const& scene, ViewPacket const& main, LastFrame const& last,
                             LastView const& seen) {
    const Moment moment{ scene, last, seen.time != main.uniforms.time, seen.isElsewhere };
    // Of opaque objects only: a pixel has one motion vector, that of the surface whose depth it has.
    MotionList moved(arena, countObjects(main.opaque), !scene.renderables.deformation.empty());
    for (DrawCall const& draw : main.opaque) {
        for (uint32_t i = 0; i < draw.instanceCount; ++i) {
            const uint32_t at = main.objects.order[draw.firstObject + i].renderable;
            Placement const& now = scene.renderables.placement[at];
            Placement const* then = last.placement(scene, at);
            const uint32_t slot = scene::deformationAt(scene.renderables, at);
            if (then && hasMoved(moment, draw, slot, now, *then)) moved.add(draw, slot, now, *then);
        }
    }
    PreparedMotion prepared{ .slots = moved.slots() };
    prepared.view.kind = ViewKind::Motion;
    prepared.view.uniforms = main.uniforms;
    prepared.view.opaque = moved.draws();
    prepared.view.objects = moved.objects(main.objects.cameraWorld);
    prepared.view.counts.visible = moved.count();
    return prepared;
}

void placeLastDeformations(Arena& arena, scene::SceneData const& scene, std::span<const uint32_t> slots,
                           LastFrame const& last, DeformationList& list) {
    if (slots.empty()) return;
    const auto places = arena.copy(list.places);
    const auto deformations = arena.array<LastDeformation>(places.size());
    const auto bones = arena.arrayForOverwrite<uint32_t>(list.skins.size()); // where those of each skin begin
    std::ranges::fill(bones, kNowhere);
    for (const uint32_t slot : slots) {
        DeformationPlace& place = places[slot];
        deformations[slot] = *last.deformation(scene, slot);
        if (const Skin skin = list.deformations[slot].skin) {
            uint32_t& first = bones[skin.index()];
            place.ownsLastBones = first == kNowhere;
            if (place.ownsLastBones) first = takeBones(list, deformations[slot].bones.size());
            place.last.bones = first;
        }
        place.last.begin = placePose(list, place.last.bones, list.deformations[slot], deformations[slot].weights);
    }
    list.places = places;
    list.last = deformations;
}

} // namespace filament_core::prepare
