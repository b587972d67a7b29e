// SPDX-License-Identifier: Apache-2.0
/// Showcase: a generated scene and sky, for users without files of their own.
///   Out     a material chart on a stage ten metres wide: seven roughnesses of a dielectric and of four metals,
///           textured, normal-mapped, masked, blended, emissive and vertex-coloured objects, one sun; about 95 000
///           triangles. The sky is in units of 22 klx: filament-render's default intensity makes it a third brighter
///           than a real one, for clearer reflections.
///   Thread  runs on the job system; the same bytes for any number of workers.
///   Fails   Unreadable if the folder cannot be written.
///   Cost    about 0.3 s on two cores; measure with `filament-render --timing`.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "jobsystem/JobSystem.h"

#include <filesystem>

namespace filament_core::showcase {

Result<assets::GlbScene> makeScene(jobs::JobSystem& jobs);

struct Files {
    std::filesystem::path model;       ///< showcase.glb
    std::filesystem::path environment; ///< showcase.hdr
};

/// Writes both into `folder`, which is created if missing; existing files are replaced.
Result<Files> writeFiles(std::filesystem::path const& folder, jobs::JobSystem& jobs);

/// Of what makeSky() computes; grows with every change of it.
inline constexpr uint32_t kSkyVersion = 1;

/// The sky alone, for models of users: "showcase-sky-1.hdr" with its version, 0.1 s. A file that is there already is
/// kept: it is written as a whole.
Result<std::filesystem::path> writeSky(std::filesystem::path const& folder, jobs::JobSystem& jobs);

} // namespace filament_core::showcase
