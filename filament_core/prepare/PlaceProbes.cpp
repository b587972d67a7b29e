// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PlaceProbes.h"

#include "backend/api/Format.h"
#include "base/math/IrradianceSh.h"
#include "filament_core/prepare/ReduceRanges.h"
#include "filament_core/prepare/ViewConstants.h"

#include <filament_core/ReflectionProbe.h>

#include <algorithm>
#include <bit>
#include <tuple>

namespace filament_core::prepare {
namespace {

using scene::ProbeRecord;

/// Points on a wall that is a face of the box are beside it by their rounding.
constexpr float kLeastBlendMeters = 1e-3f;

static_assert(ReflectionProbeDesc::kMaxOfView == shader::kMaxProbesOfView);

float3 relativeCenter(ProbeRecord const& probe, ViewSpace const& space) {
    return float3(probe.centerWorld - space.cameraWorld);
}

float blendMeters(ProbeRecord const& probe) { return std::max(probe.blendMeters, kLeastBlendMeters); }

bool reachesInto(ProbeRecord const& probe, ViewSpace const& space) {
    float3 reach(0); // along the axes of the world
    const float3 lit = probe.halfExtent + blendMeters(probe);
    for (int axis = 0; axis < 3; ++axis) reach += glm::abs(probe.worldFromBox[axis]) * lit[axis];
    return intersects(space.frustum, relativeCenter(probe, space), reach);
}

/// A box of the view in the frame of a probe's: how far its nearest and its farthest points are beyond the walls.
struct BeyondWalls {
    float nearest = 0, farthest = 0; ///< metres; inside of all walls: <= 0
};

BeyondWalls beyondWalls(LitBox const& box, ProbeRecord const& probe, ViewSpace const& space) {
    const float3 local = (box.center - relativeCenter(probe, space)) * probe.worldFromBox;
    const float3x3 boxFromWorld = glm::transpose(probe.worldFromBox);
    float3 reach(0);
    for (int axis = 0; axis < 3; ++axis) reach += glm::abs(boxFromWorld[axis]) * box.halfExtent[axis];
    const float3 near = glm::abs(local) - reach - probe.halfExtent, far = glm::abs(local) + reach - probe.halfExtent;
    return { std::max({ near.x, near.y, near.z }), std::max({ far.x, far.y, far.z }) };
}

/// Which probes reach a lit surface, by their place in the list; those beyond the 64th always do.
using ProbeSet = uint64_t;
constexpr size_t kMostTested = 64;

ProbeSet meet(LitBox const& box, scene::Probes const& probes, ViewSpace const& space, std::span<const uint32_t> inView,
              ProbeSet known) {
    ProbeSet met = 0;
    for (size_t i = 0; i < std::min(inView.size(), kMostTested); ++i) {
        ProbeRecord const& probe = probes.records[inView[i]];
        if ((known >> i & 1) == 0 && beyondWalls(box, probe, space).nearest < blendMeters(probe))
            met |= ProbeSet{ 1 } << i;
    }
    return met;
}

/// Some surface takes light of the environment: it is not wholly in a box that leaves none.
bool needsEnvironment(jobs::JobSystem& jobs, Arena& arena, scene::Probes const& probes, ViewSpace const& space,
                      std::span<const LitBox> lit, std::span<const uint32_t> chosen) {
    const auto isEnclosed = [&](LitBox const& box) {
        return std::ranges::any_of(chosen, [&](uint32_t i) {
            ProbeRecord const& probe = probes.records[i];
            return probe.lightsDiffuse && beyondWalls(box, probe, space).farthest <= 0;
        });
    };
    return reduceRanges<bool>(
            jobs, arena, lit.size(), [&](bool& open, size_t i) { open = open || !isEnclosed(lit[i]); },
            [](bool& open, bool part) { open = open || part; });
}

/// From the camera to the box, squared.
float distance2ToBox(ProbeRecord const& probe, ViewSpace const& space) {
    const float3 local = -relativeCenter(probe, space) * probe.worldFromBox;
    const float3 outside = glm::max(glm::abs(local) - probe.halfExtent, float3(0));
    return glm::dot(outside, outside);
}

/// The environment decides, or else the smallest probe.
struct ProbeStandard {
    scene::CubeShape shape{};
    scene::EnvironmentStorage storage{};
    float levelOfRoughnessOne = 0;
};

ProbeStandard standardOf(scene::SceneData const& scene, std::span<const uint32_t> inView) {
    scene::IndirectLightRecord const& light = scene.indirectLight;
    if (light.specular) return { light.shape, light.storage, light.levelOfRoughnessOne };
    ProbeRecord const& probe = scene.probes.records[inView.front()];
    return { probe.shape, probe.storage, probe.levelOfRoughnessOne };
}

ProbeUse useOf(ProbeRecord const& probe, ProbeStandard const& standard, HeldProbes const& held) {
    if (!held.hasArrays) return ProbeUse::NoArrays;
    if (!backend::isWritable(standard.shape.format)) return ProbeUse::NotCopyable;
    const bool isAlike = probe.shape == standard.shape && probe.storage.mapping == standard.storage.mapping &&
                         probe.levelOfRoughnessOne == standard.levelOfRoughnessOne;
    return isAlike ? ProbeUse::Used : ProbeUse::OtherShape;
}

/// Those whose box the frustum meets, the smallest first; equal ones by their place, so that the order of adding does
/// not count.
std::span<uint32_t> findInView(Arena& arena, scene::Probes const& probes, ViewSpace const& space) {
    const auto found = arena.arrayForOverwrite<uint32_t>(probes.records.size());
    size_t count = 0;
    for (uint32_t i = 0; i < probes.records.size(); ++i)
        if (reachesInto(probes.records[i], space)) found[count++] = i;
    std::ranges::sort(found.first(count), {}, [&](uint32_t i) {
        ProbeRecord const& probe = probes.records[i];
        const double3 at = probe.centerWorld;
        return std::tuple(probe.volume(), at.x, at.y, at.z, probes.index.handleAt(i).index());
    });
    return found.first(count);
}

/// Those of them that reach a lit surface.
std::span<const uint32_t> reachingLit(jobs::JobSystem& jobs, Arena& arena, scene::Probes const& probes,
                                      ViewSpace const& space, std::span<const LitBox> lit, std::span<uint32_t> inView) {
    const auto met = reduceRanges<ProbeSet>(
            jobs, arena, lit.size(),
            [&](ProbeSet& part, size_t i) { part |= meet(lit[i], probes, space, inView, part); },
            [](ProbeSet& whole, ProbeSet part) { whole |= part; });
    size_t kept = 0;
    for (size_t i = 0; i < inView.size(); ++i)
        if (i >= kMostTested || (met >> i & 1) != 0) inView[kept++] = inView[i];
    return inView.first(kept);
}

/// The usable probes that are nearest to the camera, at most `most`, sorted as `inView` is.
std::span<const uint32_t> chooseProbes(Arena& arena, scene::Probes const& probes, ViewSpace const& space,
                                       std::span<const uint32_t> inView, std::span<ProbeUse> uses, size_t most) {
    const auto near = arena.arrayForOverwrite<uint32_t>(inView.size());
    size_t count = 0;
    for (const uint32_t i : inView)
        if (uses[i] == ProbeUse::Used) near[count++] = i;
    const std::span usable = near.first(count);
    std::ranges::stable_sort(usable, {}, [&](uint32_t i) { return distance2ToBox(probes.records[i], space); });
    for (size_t i = most; i < count; ++i) uses[usable[i]] = ProbeUse::OverLimit;
    const auto chosen = arena.arrayForOverwrite<uint32_t>(count);
    size_t kept = 0;
    for (const uint32_t i : inView)
        if (uses[i] == ProbeUse::Used) chosen[kept++] = i;
    return chosen.first(kept);
}

/// Cubes stay in their layers, and others take the free ones.
class CubeLayers {
public:
    CubeLayers(HeldProbes const& held, scene::CubeShape const& shape) {
        if (held.shape == shape) mHeld = held.cubes;
    }

    void keep(ProbeCube const& cube) {
        const auto at = std::find(mHeld.begin() + 1, mHeld.end(), cube);
        if (at != mHeld.end()) mCubes[static_cast<size_t>(at - mHeld.begin())] = cube;
    }
    /// After all that stay.
    uint32_t layerOf(ProbeCube const& cube) {
        auto at = std::find(mCubes.begin() + 1, mCubes.end(), cube);
        if (at == mCubes.end()) at = std::find(mCubes.begin() + 1, mCubes.end(), ProbeCube{});
        *at = cube;
        return static_cast<uint32_t>(at - mCubes.begin());
    }
    /// What no probe uses stays for later frames.
    ProbeCubes finish(ProbeCube const& environment) {
        for (size_t i = 1; i < mCubes.size(); ++i)
            if (!mCubes[i].texture) mCubes[i] = mHeld[i];
        mCubes[0] = environment;
        return mCubes;
    }

private:
    ProbeCubes mHeld{}, mCubes{};
};

ProbeCube cubeOf(scene::SceneData const& scene, backend::TextureHandle texture) {
    return { texture, texture && scene.versions ? scene.versions->of(texture) : 0 };
}

/// Bands that the view leaves out are 0.
std::array<float4, 9> withBands(std::array<float4, 9> irradianceSh, uint32_t bands) {
    std::ranges::fill(std::span(irradianceSh).subspan(size_t{ bands } * bands), float4(0));
    return irradianceSh;
}

/// `factor`: from a texel to what the shader multiplies by FrameUniforms::ambient.x.
shader::ReflectionProbe probeRecord(ProbeRecord const& probe, ViewSpace const& space, float factor, uint32_t bands,
                                    uint32_t layer) {
    shader::ReflectionProbe record{};
    for (int axis = 0; axis < 3; ++axis)
        record.axes[static_cast<size_t>(axis)] = float4(probe.worldFromBox[axis], probe.halfExtent[axis]);
    record.center = float4(relativeCenter(probe, space), 1.0f / blendMeters(probe));
    record.capture = float4(probe.captureInBox, factor);
    record.irradianceSh = rotateIrradianceSh(withBands(probe.irradianceSh, bands), probe.worldFromBox);
    record.irradianceSh[0].w = static_cast<float>(layer);
    record.irradianceSh[1].w = probe.lightsDiffuse ? 1.0f : 0.0f;
    return record;
}

} // namespace

shader::ProbeUniforms noProbes() {
    shader::ReflectionProbe unused{};
    for (float4& axis : unused.axes) axis.w = -1;
    unused.center.w = 1.0f / kLeastBlendMeters;
    shader::ProbeUniforms uniforms;
    uniforms.probes.fill(unused);
    return uniforms;
}

std::span<const LitBox> litBoxes(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                 ObjectList const& objects) {
    const auto boxes = arena.arrayForOverwrite<LitBox>(objects.size());
    constexpr size_t kRange = 4096; // about 20 us
    jobs::parallelFor<"lit boxes">(jobs, objects.size(), kRange, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint32_t at = objects.order[i].renderable;
            const bool isLit = renderables.drawables[renderables.drawable[at]].material->material->isLit();
            boxes[i] = isLit ? LitBox{ float3(renderables.bounds.centerAt(at) - objects.cameraWorld),
                                       renderables.bounds.halfExtentAt(at) }
                             : kUnlitBox;
        }
    });
    return boxes;
}

ProbePacket placeProbes(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                        HeldProbes const& held, std::span<const LitBox> lit, ViewPacket& packet) {
    std::vector<ProbeRecord> const& records = scene.probes.records;
    if (records.empty() || lit.empty()) return {};
    ProbePacket probes;
    const ViewSpace space = makeViewSpace(view);
    const std::span<ProbeUse> uses = arena.arrayForOverwrite<ProbeUse>(records.size());
    std::ranges::fill(uses, ProbeUse::OutOfReach);
    probes.uses = uses;
    const std::span<const uint32_t> inView =
            reachingLit(jobs, arena, scene.probes, space, lit, findInView(arena, scene.probes, space));
    probes.outOfReach = static_cast<uint32_t>(records.size() - inView.size());
    if (inView.empty()) return probes;
    const ProbeStandard standard = standardOf(scene, inView);
    for (const uint32_t i : inView) uses[i] = useOf(records[i], standard, held);
    const std::span<const uint32_t> chosen =
            chooseProbes(arena, scene.probes, space, inView, uses,
                         std::min<size_t>(view.quality.reflectionProbes, shader::kMaxProbesOfView));
    probes.used = static_cast<uint32_t>(chosen.size());
    probes.leftOut = static_cast<uint32_t>(inView.size() - chosen.size());
    if (probes.empty()) return probes;

    shader::FrameUniforms& frame = packet.uniforms;
    const bool hasEnvironment = frame.ambient.x > 0;
    if (!hasEnvironment) frame.ambient.x = space.exposure, frame.ambient.y = standard.levelOfRoughnessOne;
    const float unit = space.exposure / frame.ambient.x;
    probes.shape = standard.shape;
    probes.storage = standard.storage;
    CubeLayers layers(held, standard.shape);
    for (const uint32_t i : chosen) layers.keep(cubeOf(scene, records[i].cube));
    auto* uniforms = arena.make<shader::ProbeUniforms>(noProbes());
    for (size_t i = 0; i < chosen.size(); ++i) {
        ProbeRecord const& probe = records[chosen[i]];
        const uint32_t layer = layers.layerOf(cubeOf(scene, probe.cube));
        uniforms->probes[i] = probeRecord(probe, space, probe.intensity * unit, view.quality.shBands, layer);
    }
    probes.uniforms = uniforms;
    probes.addsEnvironment = hasEnvironment && needsEnvironment(jobs, arena, scene.probes, space, lit, chosen);
    probes.cubes = layers.finish(hasEnvironment ? cubeOf(scene, scene.indirectLight.specular) : ProbeCube{});
    return probes;
}

} // namespace filament_core::prepare
