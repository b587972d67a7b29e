// SPDX-License-Identifier: Apache-2.0
#include "base/Hash.h"
#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/ObjectData.h"

#include <array>

namespace filament::prepare {
namespace {

template <class... T>
uint64_t hashAll(uint64_t seed, T... values) {
    const std::array<uint64_t, sizeof...(T)> words{ static_cast<uint64_t>(values)... };
    return hashBytes(std::as_bytes(std::span(words)), seed);
}

uint64_t hashDraw(DrawCall const& draw, uint64_t seed) {
    scene::Geometry const& geometry = *draw.geometry;
    seed = hashAll(seed, geometry.vertices.bits, geometry.indices.bits, geometry.layout, geometry.firstIndex,
                   geometry.indexCount, geometry.indexFormat);
    return hashAll(seed, draw.material->material->id, draw.material->id, draw.firstObject, draw.instanceCount,
                   draw.mirrored, draw.pass, draw.deformation);
}

uint64_t hashDeformations(DeformationList const& list, uint64_t seed) {
    for (size_t i = 0; i < list.places.size(); ++i) {
        DeformationPlace const& place = list.places[i];
        if (place.weights == kNowhere) continue;
        const shader::MorphUniforms weights = morphUniforms(list.deformations[i]);
        seed = hashAll(seed, i, place.bones, place.weights, place.deltas.bits);
        seed = hashBytes(std::as_bytes(std::span(&weights, 1)).first(morphBytes(list.deformations[i])), seed);
    }
    for (size_t i = 0; i < list.bones.size(); ++i) {
        if (list.bones[i] != kNowhere) seed = hashBytes(std::as_bytes(std::span(list.skins[i].bones)), seed);
    }
    return seed;
}

uint64_t hashCounts(ViewCounts const& counts, uint64_t seed) {
    return hashAll(seed, counts.renderables, counts.visible, counts.outOfView, counts.nothingToDraw,
                   counts.blendedLeftOut, counts.lights, counts.lightsOutOfView, counts.lightsOverLimit, counts.froxels,
                   counts.froxelEntries, counts.longestFroxel, counts.fullFroxels, counts.lightsLeftOut, counts.suns,
                   counts.litDraws, counts.blendedDraws, counts.triangles);
}

uint64_t hashObjects(ObjectList const& objects, uint64_t seed) {
    for (SortItem const& item : objects.order) {
        const shader::ObjectData object = objectData(objects.placements[item.renderable], objects.cameraWorld);
        seed = hashBytes(std::as_bytes(std::span(&object, 1)), seed);
    }
    return seed;
}

uint64_t hashView(ViewPacket const& view, uint64_t seed) {
    static_assert(sizeof(shader::FrameUniforms) % sizeof(float4) == 0 &&
                  sizeof(shader::PunctualLight) % sizeof(float4) == 0);
    seed = hashBytes(std::as_bytes(std::span(&view.uniforms, 1)), seed);
    seed = hashBytes(std::as_bytes(view.lights), seed);
    seed = hashBytes(std::as_bytes(view.froxels.words), seed);
    seed = hashObjects(view.objects, seed);
    for (DrawCall const& draw : view.opaque) seed = hashDraw(draw, seed);
    for (DrawCall const& draw : view.blended) seed = hashDraw(draw, seed);
    seed = hashAll(seed, view.kind, view.variant, view.lights.size(), view.objects.size(), view.opaque.size(),
                   view.blended.size());
    return hashCounts(view.counts, seed);
}

} // namespace

uint64_t hashPacket(FramePacket const& packet) {
    uint64_t hash = packet.views.size();
    for (ViewPacket const& view : packet.views) hash = hashView(view, hash);
    hash = hashDeformations(packet.deformations, hash);
    EnvironmentPacket const& environment = packet.environment;
    return hashAll(hash, environment.specular.bits, environment.irradiance.bits, environment.sky.bits,
                   environment.storage.isRgbm, environment.storage.mapping, environment.skyIsRgbm);
}

} // namespace filament::prepare
