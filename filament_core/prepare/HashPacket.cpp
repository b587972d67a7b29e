// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/HashView.h"
#include "filament_core/prepare/HashWords.h"
#include "filament_core/values/OptionRows.h"

namespace filament_core::prepare {
namespace {

uint64_t hashDeformations(DeformationList const& list, uint64_t seed) {
    for (size_t i = 0; i < list.places.size(); ++i) {
        DeformationPlace const& place = list.places[i];
        if (place.now.begin == kNowhere) continue;
        seed = hashWords(seed, i, place.now.begin, place.now.bones, place.block, place.deltas.bits);
        seed = hashWeights(list.deformations[i], seed);
        if (place.last.begin == kNowhere) continue;
        seed = hashWords(seed, place.last.begin, place.last.bones);
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

/// Of values without padding.
template <class... Values>
uint64_t hashValues(uint64_t seed, Values const&... values) {
    static_assert((!std::is_same_v<Values, bool> && ...), "switches are words");
    ((seed = hashBytes(std::as_bytes(std::span(&values, 1)), seed)), ...);
    return seed;
}

uint64_t hashEffects(Effects const& effects, uint64_t seed) {
    // One option after the other, since the struct has padding; a texture is no option.
    for (Option const& option : optionsOf<Effects>()) seed = hashBytes(bytesOf(option, &effects), seed);
    return hashWords(seed, effects.bloom.dirt.number());
}

uint64_t hashSplats(SplatPacket const& splats, uint64_t seed) {
    for (SplatList const& list : splats.lists) {
        for (SortItem const& item : list.order) seed = hashBytes(std::as_bytes(list.quads.subspan(item.draw, 1)), seed);
        seed = hashWords(seed, list.size());
    }
    return seed;
}

uint64_t hashProbes(ProbePacket const& probes, uint64_t seed) {
    seed = hashBytes(std::as_bytes(std::span(probes.uniforms, 1)), hashWords(seed, probes.addsEnvironment));
    for (ProbeCube const& cube : probes.cubes) seed = hashWords(seed, cube.texture.bits, cube.version);
    return seed;
}

} // namespace

uint64_t hashPacket(FramePacket const& packet) {
    uint64_t hash = packet.views.size();
    for (ViewPacket const& view : packet.views) hash = hashView(view, hash);
    hash = hashDeformations(packet.deformations, hash);
    if (!packet.shadows.maps.empty()) hash = hashShadows(packet.shadows, hash);
    if (!packet.discs.empty()) hash = hashBytes(std::as_bytes(packet.discs), hash);
    if (packet.splats.inScene > 0) hash = hashSplats(packet.splats, hash);
    if (!packet.probes.empty()) hash = hashProbes(packet.probes, hash);
    if (!packet.fields().empty()) hash = hashBytes(std::as_bytes(packet.fields()), hash);
    hash = hashEffects(packet.settings.effects, hash);
    hash = hashBytes(std::as_bytes(std::span(&packet.last.clipFromWorld, 1)), hash);
    hash = hashWords(hash, packet.motionView, packet.accumulation.isFixed, packet.last.isExposed,
                     packet.last.isReflected);
    hash = hashValues(hash, packet.settings.size, packet.settings.shownSize, packet.settings.band, packet.covered,
                      packet.accumulation.jitterPixels, packet.accumulation.weight, packet.accumulation.ramp,
                      packet.focus, packet.last.secondsSince, packet.fogAccumulation.place,
                      packet.fogAccumulation.weight, packet.fogAccumulation.exposure);
    EnvironmentPacket const& environment = packet.environment;
    return hashWords(hash, environment.specular.bits, environment.irradiance.bits, environment.sky.bits,
                     environment.storage.isRgbm, environment.storage.mapping, environment.skyIsRgbm,
                     environment.skyHasGround);
}

} // namespace filament_core::prepare
