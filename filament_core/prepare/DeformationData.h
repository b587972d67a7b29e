// SPDX-License-Identifier: Apache-2.0
/// Bones and morph weights of visible objects in the form that the vertex stage reads: rows of a texture, in which the
/// bones of all visible skins follow each other, and a buffer, in which every visible deformation with morph targets
/// has a block with its weights, and all skins of one kind share a block; draws bind windows of it. Where the bones of
/// an object begin is in its ObjectData, so that instances of one draw have poses of their own.
///   In      the deformations of the scene, and which draws culling has seen in each view.
///   Out     where each skin and block begins; the functions that write fill the memory of the upload commands.
///   Thread  placeDeformations(): the app thread. writeBones(), writeDeformations(): jobs over skins and blocks.
///   Memory  the arena: 16 B per slot of Deformations and of skins. None in scenes without deformations.
///   Bits    blocks follow the order of the slots; the same for any number of workers.
///   Limits  kMaxActiveTargets weights of one deformation that are not 0: of more, those of the largest magnitude.
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

/// bones.size() <= list.boneCount: those that the device has room for.
void writeBones(jobs::JobSystem& jobs, DeformationList const& list, std::span<shader::BoneData> bones);
/// memory.size() == list.bytes. Of skins that end behind bone `boneRoom`, the mesh is drawn at rest.
void writeDeformations(jobs::JobSystem& jobs, DeformationList const& list, uint32_t boneRoom,
                       std::span<std::byte> memory);

/// Bytes of the block of a deformation with these weights of its targets.
uint32_t deformationBlock(std::span<const float> weights);
/// Of the weights, and what else determines a block.
uint64_t hashWeights(scene::Deformation const& deformation, uint64_t seed);

} // namespace filament_core::prepare
