// SPDX-License-Identifier: Apache-2.0
/// Bones and morph weights of visible objects in the form that the vertex stage reads: one buffer per frame, in which
/// every visible skin has a block of bones and every visible deformation a block of weights; draws bind windows of it.
///   In      the deformations of the scene, and which draws culling has seen in each view.
///   Out     where each block begins; writeDeformations() fills the memory of the upload command.
///   Thread  placeDeformations(): the app thread. writeDeformations(): jobs over blocks.
///   Memory  the arena: 16 B per slot of Deformations and of skins. None in scenes without deformations.
///   Bits    blocks follow the order of the slots; the same for any number of workers.
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

/// memory.size() == list.bytes.
void writeDeformations(jobs::JobSystem& jobs, DeformationList const& list, std::span<std::byte> memory);

/// The vertex stage's data for one deformation and `weights` of its targets: those whose weight is not 0, in their
/// order.
shader::MorphUniforms morphUniforms(scene::Deformation const& deformation, std::span<const float> weights);
/// Its used bytes: up to the last target.
uint32_t morphBytes(std::span<const float> weights);
/// What a block of `bytes` occupies.
uint32_t deformationBlock(size_t bytes);

} // namespace filament_core::prepare
