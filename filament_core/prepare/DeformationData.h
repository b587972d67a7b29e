// SPDX-License-Identifier: Apache-2.0
/// Poses of visible objects in the form that the vertex stage reads: rows of a texture, in which the bones of all
/// visible skins follow each other, with the records of morph weights between them, and a buffer of uniforms, in which
/// all deformations of one kind share a block; draws bind windows of it. Where the pose of an object begins is in its
/// ObjectData, so that instances of one draw have poses of their own.
///   In      the deformations of the scene, and which draws culling has seen in each view.
///   Out     where each pose and block begins; the functions that write fill the memory of the upload commands.
///   Thread  placeDeformations(): the app thread. writeBones(): jobs over skins and records.
///   Memory  the arena: 36 B per slot of Deformations, 4 B per skin. None in scenes without deformations.
///   Bits    poses follow the order of the slots; the same for any number of workers.
///   Limits  the room of the texture, at least a million bones: what begins behind it is drawn at rest.
///   Fails   never.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/CullRenderables.h"
#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

/// `views`: everything visible in any of them, each skin and each deformation once.
DeformationList placeDeformations(Arena& arena, scene::SceneData const& scene, std::span<const VisibleItems> views);

/// Where room for so many begins: for a skin, or for a record of weights.
uint32_t takeBones(DeformationList& list, size_t count);
/// Takes room for a record if there are morph targets. Returns where the pose begins; `bones`: those of its skin.
uint32_t placePose(DeformationList& list, uint32_t bones, scene::Deformation const& deformation,
                   std::span<const float> weights);

/// Skins and records of weights. bones.size() <= list.boneCount: those that the device has room for.
void writeBones(jobs::JobSystem& jobs, DeformationList const& list, std::span<shader::BoneData> bones);
/// The uniforms. memory.size() == list.bytes. Of skins that end behind bone `boneRoom`, the mesh is drawn at rest.
void writeDeformations(DeformationList const& list, uint32_t boneRoom, std::span<std::byte> memory);

/// Of the weights, and what else determines a block.
uint64_t hashWeights(scene::Deformation const& deformation, uint64_t seed);

} // namespace filament_core::prepare
