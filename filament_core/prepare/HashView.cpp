// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/HashView.h"

#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/HashWords.h"
#include "filament_core/prepare/ObjectData.h"

#include <bit>

namespace filament_core::prepare {
namespace {

uint64_t hashDraw(DrawCall const& draw, uint64_t seed) {
    scene::Geometry const& geometry = *draw.geometry;
    seed = hashWords(seed, geometry.vertices.bits, geometry.indices.bits, geometry.layout, geometry.firstIndex,
                     geometry.indexCount, geometry.indexFormat);
    return hashWords(seed, draw.material->material->id, draw.material->id, draw.firstObject, draw.instanceCount,
                     draw.mirrored, draw.properties.bits(), draw.pass, draw.deformation, draw.fade);
}

uint64_t hashCounts(ViewCounts const& counts, uint64_t seed) {
    return hashWords(seed, counts.renderables, counts.visible, counts.outOfView, counts.tooSmall, counts.nothingToDraw,
                     counts.inOtherLayers, counts.occluded, counts.blendedLeftOut, counts.lights, counts.areaLights,
                     counts.areaLightsLeftOut, counts.profiledLights, counts.profiledLightsLeftOut,
                     counts.profilesOverLimit, counts.imagedLights, counts.imagedLightsLeftOut, counts.imagesOverLimit,
                     counts.lightsOutOfView, counts.lightsOfOtherChannels, counts.sunsOfOtherChannels,
                     counts.lightsOverLimit, counts.froxels, counts.froxelEntries, counts.longestFroxel,
                     counts.fullFroxels, counts.lightsLeftOut, counts.suns, counts.litDraws, counts.blendedDraws,
                     counts.triangles);
}

uint64_t hashChannels(ChannelLists const& channels, uint64_t seed) {
    for (ChannelLights const& list : channels.lists) {
        seed = hashBytes(std::as_bytes(std::span(&list.uniforms, 1)), seed);
        seed = hashBytes(std::as_bytes(list.lights), seed);
        seed = hashBytes(std::as_bytes(list.froxels.words), seed);
        seed = hashWords(seed, list.hasSun, list.lights.size());
    }
    return hashBytes(std::as_bytes(channels.listOf), seed);
}

uint64_t hashProfiles(ProfileLists const& profiles, uint64_t seed) {
    seed = hashBytes(std::as_bytes(profiles.lights), seed);
    for (const std::span<const uint32_t> table : profiles.tables) seed = hashBytes(std::as_bytes(table), seed);
    return hashWords(seed, profiles.lights.size(), profiles.tables.size());
}

// Of tables the head, with the image's number.
uint64_t hashImages(LightImageLists const& images, uint64_t seed) {
    seed = hashBytes(std::as_bytes(images.records), seed);
    for (const std::span<const uint32_t> table : images.tables)
        seed = hashBytes(std::as_bytes(table.first(shader::kImageHeaderWords)), seed);
    return hashWords(seed, images.records.size(), images.tables.size());
}

uint64_t hashObjects(ObjectList const& objects, uint64_t seed) {
    // What shaders read, not the indices: adding a renderable that is out of view moves others, and changes no map.
    for (SortItem const& item : objects.order) {
        const shader::ObjectData object = objectData(objects.placements[item.renderable], objects.cameraWorld);
        seed = hashBytes(std::as_bytes(std::span(&object, 1)), seed);
    }
    return seed;
}

uint64_t hashDeformation(scene::SceneData const& scene, uint32_t slot, uint64_t seed) {
    scene::Deformation const& deformation = scene.deformations.all()[slot];
    seed = hashWeights(deformation, seed);
    if (deformation.morph) seed = hashWords(seed, deformation.morph->deltas.bits);
    if (deformation.skin) {
        std::vector<shader::BoneData> const& bones = scene.deformations.skins()[deformation.skin.index()].bones;
        seed = hashBytes(std::as_bytes(std::span(bones)), seed);
    }
    return seed;
}

uint64_t hashVersions(scene::ContentVersions const* versions, scene::Geometry const& geometry, uint64_t seed) {
    if (!versions) return seed;
    uint32_t vertices = versions->of(geometry.vertices);
    const uint32_t indices = versions->of(geometry.indices);
    for (const backend::BufferHandle stream : geometry.streams)
        vertices += stream ? versions->of(stream) : 0;                            // versions only grow
    return (vertices | indices) != 0 ? hashWords(seed, vertices, indices) : seed; // most never change
}

/// What a material's own code can make of its depth.
uint64_t hashDepthInputs(scene::MaterialInstance const& instance, shader::FrameUniforms const& frame, bool isColored,
                         scene::ContentVersions const* versions, uint64_t seed) {
    shader::MaterialPackage const& package = instance.material->package;
    if (package.sectionPlanes) {
        seed = hashBytes(std::as_bytes(std::span(frame.sectionPlanes)), seed);
        seed = hashBytes(std::as_bytes(std::span(&frame.section, 1)), seed);
    }
    if (!package.depthReadsParameters && !(isColored && shader::transmitsLight(package))) return seed;
    seed = hashBytes(instance.parameters, seed);
    for (scene::TextureBinding const& bound : instance.textures)
        seed = hashWords(seed, bound.texture.bits, versions ? versions->of(bound.texture) : 0);
    if (!package.readsFrame) return seed;
    seed = hashBytes(std::as_bytes(std::span(&frame.time, 1)), seed);
    return hashBytes(std::as_bytes(std::span(frame.materialGlobals)), seed);
}

uint64_t hashProjection(shader::FrameUniforms const& frame, uint64_t seed) {
    // The matrix takes positions relative to the camera, and alone would not say where the map is.
    seed = hashBytes(std::as_bytes(std::span(&frame.clipFromWorld, 1)), seed);
    return hashBytes(std::as_bytes(std::span(&frame.cameraPosition, 1)), seed);
}

} // namespace

uint64_t hashView(ViewPacket const& view, uint64_t seed) {
    static_assert(sizeof(shader::FrameUniforms) % sizeof(float4) == 0 &&
                  sizeof(shader::PunctualLight) % sizeof(float4) == 0);
    seed = hashBytes(std::as_bytes(std::span(&view.uniforms, 1)), seed);
    seed = hashBytes(std::as_bytes(view.lights), seed);
    seed = hashBytes(std::as_bytes(view.froxels.words), seed);
    seed = hashChannels(view.channels, seed);
    seed = hashProfiles(view.profiles, seed);
    seed = hashImages(view.images, seed);
    seed = hashObjects(view.objects, seed);
    for (DrawCall const& draw : view.opaque) seed = hashDraw(draw, seed);
    for (DrawCall const& draw : view.blended) seed = hashDraw(draw, seed);
    seed = hashWords(seed, view.kind, view.variant, view.hasAreaLights, view.lights.size(), view.objects.size(),
                     view.opaque.size(), view.blended.size());
    seed = hashWords(seed, view.anyOrder.first, view.anyOrder.end,
                     std::bit_cast<uint32_t>(view.anyOrder.nearestMeters));
    for (SceneColorCopy const& copy : view.pictures)
        seed = hashWords(seed, copy.rect.x, copy.rect.y, copy.rect.width, copy.rect.height, copy.levels,
                         copy.firstDraw);
    return hashCounts(view.counts, seed);
}

uint64_t hashShadowView(scene::SceneData const& scene, ViewPacket const& view, uint32_t mapSize, bool isColored) {
    uint64_t hash = hashWords(mapSize, isColored, view.objects.size(), view.opaque.size());
    hash = hashProjection(view.uniforms, hash);
    hash = hashObjects(view.objects, hash);
    for (DrawCall const& draw : view.opaque) {
        hash = hashDraw(draw, hash);
        hash = hashVersions(scene.versions, *draw.geometry, hash);
        const scene::InstanceRaster raster = scene::inShadowMaps(draw.material->raster);
        hash = hashWords(hash, static_cast<uint32_t>(raster.culling), static_cast<uint32_t>(raster.cullingDisabled));
        hash = hashDepthInputs(*draw.material, view.uniforms, isColored, scene.versions, hash);
        if (draw.deformation == scene::kNotDeformed) continue;
        for (SortItem const& item : view.objects.order.subspan(draw.firstObject, draw.instanceCount))
            hash = hashDeformation(scene, scene::deformationAt(scene.renderables, item.renderable), hash);
    }
    return hash;
}

} // namespace filament_core::prepare
