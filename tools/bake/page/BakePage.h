// SPDX-License-Identifier: Apache-2.0
/// BakePage: the HTML report of a lightmap or of a grid: one view before, after and traced (ScenePictures.h); what was
/// baked as images; every chart or probe with its error, every leak, and what the held-out points say.
///   Out     ReportOptions::file. The same numbers as in the JSON report.
///   Thread  one at a time; works on the job system.
///   Fails   Unreadable with the path; errors of the path tracer. Without a device the page states why it has fewer
///           images, and a line goes to standard error.
#pragma once

#include "tools/bake/IrradianceBake.h"
#include "tools/bake/Report.h"

namespace filament_core::bake {

/// `model`: with the lightmap. `lights`: of the texels, then of the held-out points.
Result<void> writeLightmapPage(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
                               LightmapImage const& image, StoredLightmap const& stored,
                               std::filesystem::path const& model, jobs::JobSystem& jobs);

Result<void> writeGridPage(Options const& options, reference::TracedScene const& scene, BakedGrid const& baked,
                           jobs::JobSystem& jobs);

} // namespace filament_core::bake
