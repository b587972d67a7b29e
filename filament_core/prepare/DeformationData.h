// SPDX-License-Identifier: Apache-2.0
/// Bones and morph weights of what is visible, as the vertex stage reads them: one buffer a frame, in which every
/// visible skin has a block of bones and every visible deformation a block of weights; draws bind windows of it.
///   In      the deformations of the scene, and which draws culling has seen in each view.
///   Out     where each block begins; writeDeformations() fills the memory that the upload command carries.
///   Thread  placeDeformations(): the app thread. writeDeformations(): jobs over blocks.
///   Memory  the arena: 16 B a slot of Deformations and of skins. Nothing in scenes without deformations.
///   Bits    blocks follow the order of the slots; the same for any number of workers.
///   Fails   never.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/CullRenderables.h"
#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament::prepare {

/// `views`: of what any of them has seen, each skin and each deformation once.
DeformationList placeDeformations(Arena& arena, scene::SceneData const& scene, std::span<const VisibleItems> views);

/// memory.size() == list.bytes.
void writeDeformations(jobs::JobSystem& jobs, DeformationList const& list, std::span<std::byte> memory);

/// What the vertex stage is told about one deformation; the targets whose weight is not 0, in their order.
shader::MorphUniforms morphUniforms(scene::Deformation const& deformation);
/// Bytes of it that are not left out: those up to the last target.
uint32_t morphBytes(scene::Deformation const& deformation);

} // namespace filament::prepare
