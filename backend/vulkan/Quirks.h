// SPDX-License-Identifier: Apache-2.0
/// Quirks: deviations of drivers from the Vulkan specification, and their workarounds. A quirk that is false costs
/// nothing. Remove one when no supported driver has it.
///   Thread  any; plain values.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Api.h"

#include <cstdint>
#include <span>

namespace filament_core::backend::vulkan {

struct Quirks {
    /// Driver  lavapipe, found in Mesa 22.3.6.
    /// What    crashes on conditions that mix a parameter with what differs from fragment to fragment, such as
    ///         `if (materialParams.x * uv.x > 0.0)`, where the parameters are in the fourth uniform buffer of a stage.
    /// Why     it records uniforms that decide an `if` in a table of 4 x 32, but writes to [32 b + i] instead of
    ///         [4 b + i], where b is 1 for the first uniform buffer of the stage. The entries of the fourth buffer
    ///         overwrite the counts behind the table. If a whole condition is uniform, the counts are restored, but
    ///         `uniform * varying > 0.0` leaves them corrupted, and the driver reads through a wild pointer when it
    ///         draws. The entries of later buffers land where no stage of a graphics pipeline reads.
    /// Cure    spareBindings().
    /// Cost    up to three more descriptors in each set with dynamic uniform buffers; nothing is ever bound to them.
    /// Test    tests/samples/materials/ConditionTest.cpp crashes without it.
    bool spoilsFourthUniforms = false;

    /// Driver  lavapipe, found in Mesa 22.3.6.
    /// What    recompiles a stage for every draw that binds other uniforms, 3 to 4 ms each, where uniforms alone
    ///         decide a condition: a material whose roughness is a parameter, say, and not a texture.
    /// Why     it puts the values of such uniforms into the code (lvp_inline_uniforms), and gives up only where the
    ///         stage does not shrink to half. So its source reads; but it subtracts unsigned sizes, and continues where
    ///         the stage grows. Its shader cache hides that only as long as values stay the same. A condition that
    ///         mixes a uniform with what varies is tried, too: every draw then copies the intermediate code of its
    ///         stage, and keeps it as long as the pipeline, or for ever: 40 MB a frame for the 64 materials of the
    ///         showcase.
    /// Cure    hideUniformConditions().
    /// Cost    one operation for each such condition, on this driver only.
    /// Test    tests/filament_core/engine/CompilationsTest.cpp, tests/tools/view/app/WindowStormTest.cpp.
    bool inlinesUniforms = false;

    /// Driver  lavapipe, found in Mesa 25.0.7 and 26.1.6; 22.3.6 does not have it.
    /// What    after a pipeline without colour attachments, all attachments of the later pipelines of a command buffer
    ///         are blended and masked like their first. A tone mapper that reads attachment 0 and writes 1 in a second
    ///         subpass leaves 1 unchanged, and so the whole image, in every frame that also has a depth-only pass.
    /// Why     handle_graphics_pipeline() of lvp_execute.c clears all blend state, and with it that attachments have
    ///         their own (independent_blend_enable), which only the start of a command buffer sets.
    /// Cure    colorReferences(): such a pass has one colour, which is unused.
    /// Cost    a reference that names nothing, in passes of depth alone.
    /// Test    tests/backend/vulkan/QuirksTest.cpp shows the fault; Pass.AttachmentsKeepTheirOwnBlendingAfterDepthAlone
    ///         of tests/backend/create requires the cure.
    /// Remove  when the oldest Mesa that is supported has the correction that docs/driver-faults.md proposes.
    bool clearsIndependentBlend = false;

    /// Driver  lavapipe, found in Mesa 22.3.6.
    /// What    a texture of BC7Srgb is sampled to other bits than a texture of RGBA8Srgb of its decoded texels.
    /// Why     codes of blocks are looked up in a table of sRGB (util_format_bptc_srgba_fetch_rgba), those of texels
    ///         are converted by a polynomial (lp_build_srgb_to_linear).
    /// Cure    DeviceFeatures::exactSrgbBlocks is false: colours are decoded when they are loaded.
    /// Cost    four times the memory of those textures.
    /// Test    tests/backend/create/BlockSamplingTest.cpp
    bool convertsSrgbOfBlocks = false;

    static Quirks of(VkDriverId driver);
};

/// Changes what is known of a device, for tests: without a quirk's cure they show its fault.
using QuirkFilter = void (*)(Quirks&);

inline constexpr size_t kMaxSpareBindings = 2;

/// For spoilsFourthUniforms: every stage that sees dynamic uniform buffers of this group, which are the engine's and
/// come before those of materials, gets spare ones up to the fourth. Returns how many of `bindings` it has filled.
uint32_t spareBindings(BindGroupLayout const& layout,
                       std::span<VkDescriptorSetLayoutBinding, kMaxSpareBindings> bindings);

/// The number of colours in each subpass and in the blend state of its pipelines: those of the pass; at least one for
/// clearsIndependentBlend.
uint32_t colorReferences(Quirks const& quirks, PassLayout const& layout);

} // namespace filament_core::backend::vulkan
