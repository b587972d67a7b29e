// SPDX-License-Identifier: Apache-2.0
/// The Pass bind group: the size of a pass's target, and the engine's textures that its materials read.
///   Use     declareTarget() while the pass declares itself, passGroup() in its `beforePass`.
///   Thread  the app thread.
///   Memory  the graph's pool keeps the groups; equal ones are made once (PassContext::bindGroup()).
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "framegraph/PassContext.h"
#include "shaders/package/GroupLayouts.h"

namespace filament::passes {

/// For a pass that draws to `level` of `texture`, or draws `samples` a pixel and resolves them to it.
PassBlock declareTarget(FrameContext const& context, framegraph::GraphTextureDesc const& texture, uint8_t level = 0,
                        uint8_t samples = 1);

backend::BindGroupHandle passGroup(framegraph::PassContext& pass, FrameContext const& context, shader::PassKind kind,
                                   PassBlock target);

} // namespace filament::passes
