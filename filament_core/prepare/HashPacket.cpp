// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/HashView.h"
#include "filament_core/prepare/HashWords.h"

namespace filament::prepare {
namespace {

uint64_t hashDeformations(DeformationList const& list, uint64_t seed) {
    for (size_t i = 0; i < list.places.size(); ++i) {
        DeformationPlace const& place = list.places[i];
        if (place.weights == kNowhere) continue;
        std::span<const float> now = list.deformations[i].weights;
        const shader::MorphUniforms weights = morphUniforms(list.deformations[i], now);
        seed = hashWords(seed, i, place.bones, place.weights, place.deltas.bits);
        seed = hashBytes(std::as_bytes(std::span(&weights, 1)).first(morphBytes(now)), seed);
        if (place.lastWeights == kNowhere) continue;
        seed = hashWords(seed, place.lastBones, place.lastWeights);
        seed = hashBytes(std::as_bytes(list.last[i].bones), seed);
        seed = hashBytes(std::as_bytes(list.last[i].weights), seed);
    }
    for (size_t i = 0; i < list.bones.size(); ++i) {
        if (list.bones[i] != kNowhere) seed = hashBytes(std::as_bytes(std::span(list.skins[i].bones)), seed);
    }
    return seed;
}

uint64_t hashShadows(ShadowPacket const& shadows, uint64_t seed) {
    for (ShadowMapPacket const& map : shadows.maps)
        seed = hashWords(seed, map.held.owner, map.held.contents, map.held.tile.x, map.held.tile.y, map.held.tile.size,
                         map.view);
    if (shadows.uniforms) seed = hashBytes(std::as_bytes(std::span(shadows.uniforms, 1)), seed);
    return hashWords(seed, shadows.atlasSize, shadows.keepsAtlas);
}

// Fog and contact shadows are in the uniforms of the views, but for two switches.
uint64_t hashEffects(Effects const& effects, uint64_t seed) {
    seed = hashBytes(std::as_bytes(std::span(&effects.ambientOcclusion, 1)), seed);
    seed = hashBytes(std::as_bytes(std::span(&effects.reflections, 1)), seed);
    const std::array bloom{ effects.bloom.strength, effects.bloom.radius, effects.bloom.threshold };
    seed = hashBytes(std::as_bytes(std::span(bloom)), hashWords(seed, effects.bloom.enabled));
    return hashWords(seed, effects.fog.enabled, effects.fog.colorFromEnvironment);
}

} // namespace

uint64_t hashPacket(FramePacket const& packet) {
    uint64_t hash = packet.views.size();
    for (ViewPacket const& view : packet.views) hash = hashView(view, hash);
    hash = hashDeformations(packet.deformations, hash);
    if (!packet.shadows.maps.empty()) hash = hashShadows(packet.shadows, hash);
    if (!packet.discs.empty()) hash = hashBytes(std::as_bytes(packet.discs), hash);
    hash = hashEffects(packet.effects, hash);
    hash = hashBytes(std::as_bytes(std::span(&packet.last.clipFromWorld, 1)), hash);
    hash = hashWords(hash, packet.motionView);
    EnvironmentPacket const& environment = packet.environment;
    return hashWords(hash, environment.specular.bits, environment.irradiance.bits, environment.sky.bits,
                     environment.storage.isRgbm, environment.storage.mapping, environment.skyIsRgbm);
}

} // namespace filament::prepare
