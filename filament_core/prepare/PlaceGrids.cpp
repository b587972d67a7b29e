// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PlaceGrids.h"

#include "base/math/IrradianceSh.h"
#include "filament_core/prepare/ObjectData.h"
#include "filament_core/prepare/ViewConstants.h"

#include <algorithm>
#include <tuple>

namespace filament_core::prepare {
namespace {

using scene::GridRecord;
using GridList = std::span<GridRecord const* const>;

constexpr size_t kFieldsOfJob = 4; // 10 us and more each
constexpr float kThinnestHalfMeters = 1e-6f;
constexpr float kLeastReachMeters = 1e-3f;

bool reachesIntoView(GridRecord const& grid, ViewSpace const& space) {
    float3 reach(0); // along the axes of the world
    const float3 lit = grid.halfExtent + std::max(grid.blendMeters, kLeastReachMeters);
    for (int axis = 0; axis < 3; ++axis) reach += glm::abs(grid.worldFromBox[axis]) * lit[axis];
    return intersects(space.frustum, float3(grid.centerWorld - space.cameraWorld), reach);
}

/// The smallest first; equal ones by their place, so that the order of adding does not count.
GridList bySize(Arena& arena, scene::Grids const& grids) {
    const auto list = arena.arrayForOverwrite<GridRecord const*>(grids.records.size());
    for (size_t i = 0; i < list.size(); ++i) list[i] = &grids.records[i];
    std::ranges::sort(list, {}, [&](GridRecord const* grid) {
        const double3 at = grid->centerWorld;
        const auto place = static_cast<size_t>(grid - grids.records.data());
        return std::tuple(grid->volume(), at.x, at.y, at.z, grids.index.handleAt(static_cast<uint32_t>(place)).index());
    });
    return list;
}

/// Along the axes of the world, candela / m2.
IrradianceSh environmentOf(scene::SceneData const& scene, shader::FrameUniforms const& frame) {
    IrradianceSh light{};
    if (!scene.indirectLight.specular) return light;
    for (size_t i = 0; i < light.size(); ++i)
        light[i] = float3(scene.indirectLight.irradianceSh[i]) * scene.indirectLight.illuminance.value;
    return rotateIrradianceSh(light, float3x3(frame.worldFromEnvironment));
}

FieldBox fieldBoxOf(scene::Renderables const& renderables, uint32_t renderable) {
    return { renderables.bounds.centerAt(renderable), renderables.bounds.halfExtentAt(renderable) };
}

class FieldPlacer {
public:
    FieldPlacer(Arena& arena, scene::SceneData const& scene, ViewPacket const& view)
            : mScene(scene), mView(view), mGrids(bySize(arena, scene.grids)),
              mRenderables(arena.arrayForOverwrite<uint32_t>(view.objects.size())) {}

    /// Numbers the fields of the draws that have some.
    std::span<const DrawCall> number(Arena& arena, std::span<const DrawCall> draws) {
        const std::span<DrawCall> numbered = arena.copy(draws);
        for (size_t i = 0; i < numbered.size(); ++i) {
            DrawCall& draw = numbered[i];
            if (draw.pass == DrawPass::Second)
                draw.firstField = numbered[i - 1].firstField; // the same object
            else if (draw.material->material->isLit() && isReached(draw))
                draw.firstField = add(draw);
        }
        return numbered;
    }

    std::span<const uint32_t> renderables() const { return mRenderables.first(mCount); }

    LightField fit(FieldBox const& box, IrradianceSh const& environment) const {
        constexpr size_t kMost = 16; // of the grids that meet in one box; the smallest count
        std::array<GridRecord const*, kMost> near{};
        size_t count = 0;
        for (GridRecord const* grid : mGrids)
            if (count < kMost && reaches(*grid, box)) near[count++] = grid;
        if (count > 0) return fitField(std::span(near).first(count), environment, box);
        LightField field; // beside one that has a grid, in the same draw
        std::copy_n(environment.begin(), 4, field.middle.begin());
        std::copy_n(environment.begin() + 4, 5, field.constant.begin());
        return field;
    }

private:
    uint32_t renderableOf(DrawCall const& draw, uint32_t nth) const {
        return mView.objects.order[draw.firstObject + nth].renderable;
    }
    bool isReached(DrawCall const& draw) const {
        for (uint32_t nth = 0; nth < draw.instanceCount; ++nth) {
            const FieldBox box = fieldBoxOf(mScene.renderables, renderableOf(draw, nth));
            for (GridRecord const* grid : mGrids)
                if (reaches(*grid, box)) return true;
        }
        return false;
    }
    uint32_t add(DrawCall const& draw) {
        const auto first = static_cast<uint32_t>(mCount);
        for (uint32_t nth = 0; nth < draw.instanceCount; ++nth) mRenderables[mCount++] = renderableOf(draw, nth);
        return first;
    }

    scene::SceneData const& mScene;
    ViewPacket const& mView;
    GridList mGrids;
    std::span<uint32_t> mRenderables; // of each field
    size_t mCount = 0;
};

/// `unit`: from candela / m2 to what the shader multiplies by FrameUniforms::ambient.x.
void write(shader::IrradianceField& to, LightField const& field, FieldBox const& box, double3 const& cameraWorld,
           float unit) {
    to.center = float4(float3(box.centerWorld - cameraWorld), 0);
    to.inverseHalf = float4(1.0f / glm::max(box.halfExtent, float3(kThinnestHalfMeters)), 0);
    for (size_t i = 0; i < 4; ++i) {
        for (int channel = 0; channel < 3; ++channel)
            to.linear[3 * i + static_cast<size_t>(channel)] =
                    unit * float4(field.change[i][0][channel], field.change[i][1][channel], field.change[i][2][channel],
                                  field.middle[i][channel]);
    }
    for (size_t i = 0; i < 5; ++i) to.constant[i] = float4(unit * field.constant[i], 0);
}

} // namespace

void FieldCache::begin(Lighting const& lighting, size_t renderables) {
    if (!(mLighting == lighting)) {
        for (Entry& entry : mEntries) entry.isKnown = false;
        mLighting = lighting;
    }
    if (mEntries.size() < renderables) mEntries.resize(renderables);
}

GridPacket findGrids(Arena& arena, scene::SceneData const& scene, ViewInput const& view, ViewPacket& packet) {
    std::vector<GridRecord> const& records = scene.grids.records;
    if (records.empty() || packet.counts.litDraws == 0) return {};
    const ViewSpace space = makeViewSpace(view);
    const std::span<uint8_t> inView = arena.arrayForOverwrite<uint8_t>(records.size());
    GridPacket grids;
    for (size_t i = 0; i < records.size(); ++i) {
        inView[i] = reachesIntoView(records[i], space) ? 1 : 0;
        ++(inView[i] != 0 ? grids.used : grids.outOfReach);
    }
    grids.inView = inView;
    if (grids.used == 0) return grids;
    // Light is stored in units of the environment's; without one, pre-exposed, which half floats can hold. Before light
    // is left out for shares (DarkLights.h), so that the light of grids goes with the environment's.
    float& ambient = packet.uniforms.ambient.x;
    grids.isEnvironmentDark = !(ambient > 0);
    if (grids.isEnvironmentDark) ambient = 1, packet.uniforms.irradianceSh = {};
    grids.unit = space.exposure / ambient;
    return grids;
}

void placeFields(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                 FieldCache* cache, FramePacket& packet) {
    if (packet.grids.used == 0) return;
    const std::span<ViewPacket> views = arena.copy(packet.views);
    ViewPacket& main = views[0];
    FieldPlacer placer(arena, scene, main);
    main.opaque = placer.number(arena, main.opaque);
    main.blended = placer.number(arena, main.blended);
    const std::span<const uint32_t> renderables = placer.renderables();
    if (renderables.empty()) return;
    packet.views = views;

    const IrradianceSh environment = environmentOf(scene, main.uniforms);
    if (cache) cache->begin({ scene.serial, scene.grids.changes, environment }, scene.renderables.count());
    const auto fields = arena.array<shader::IrradianceField>(renderables.size());
    const auto errors = arena.arrayForOverwrite<float>(renderables.size());
    const auto fitted = arena.arrayForOverwrite<uint8_t>(renderables.size());
    jobs::parallelFor<"irradiance fields">(jobs, renderables.size(), kFieldsOfJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint32_t at = renderables[i];
            const FieldBox box = fieldBoxOf(scene.renderables, at);
            FieldCache::Entry local;
            FieldCache::Entry& entry = cache ? (*cache)[at] : local;
            fitted[i] = entry.isKnown && entry.box == box ? 0 : 1;
            if (fitted[i] != 0) entry = { box, placer.fit(box, environment), true };
            errors[i] = entry.field.error;
            fields[i].object = objectData(scene.renderables.placement[at], main.objects.cameraWorld);
            fields[i].object.flags.w = main.objects.poseBegin(at);
            write(fields[i], entry.field, box, makeViewSpace(view).cameraWorld, packet.grids.unit);
        }
    });
    packet.grids.fields = fields;
    for (size_t i = 0; i < fields.size(); ++i) packet.grids.evaluated += fitted[i];
    packet.grids.largestError = *std::ranges::max_element(errors);
}

} // namespace filament_core::prepare
