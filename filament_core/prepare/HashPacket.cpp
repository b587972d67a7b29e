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
                   geometry.indexCount, geometry.indexType);
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

uint64_t hashCounts(PacketCounts const& counts, uint64_t seed) {
    return hashAll(seed, counts.renderables, counts.visible, counts.outOfView, counts.nothingToDraw, counts.lights,
                   counts.lightsOutOfView, counts.lightsOverLimit, counts.suns, counts.triangles);
}

} // namespace

uint64_t hashPacket(FramePacket const& packet) {
    static_assert(sizeof(shader::FrameUniforms) % sizeof(float4) == 0 &&
                  sizeof(shader::LightData) % sizeof(float4) == 0);
    uint64_t hash = hashBytes(std::as_bytes(std::span(&packet.frame, 1)));
    hash = hashBytes(std::as_bytes(packet.lights), hash);
    for (SortItem const& item : packet.objects.order) {
        const shader::ObjectData object =
                objectData(packet.objects.placements[item.renderable], packet.objects.cameraWorld);
        hash = hashBytes(std::as_bytes(std::span(&object, 1)), hash);
    }
    hash = hashDeformations(packet.deformations, hash);
    for (DrawCall const& draw : packet.opaque) hash = hashDraw(draw, hash);
    for (DrawCall const& draw : packet.blended) hash = hashDraw(draw, hash);
    hash = hashAll(hash, packet.opaque.size(), packet.blended.size(), packet.variant, packet.specular.bits,
                   packet.irradiance.bits, packet.sky.bits, packet.environment.isRgbm, packet.environment.mapping,
                   packet.skyIsRgbm);
    return hashCounts(packet.counts, hash);
}

} // namespace filament::prepare
