// SPDX-License-Identifier: Apache-2.0
/// MesaEnvironment: the environment variables that Mesa's software rasteriser (llvmpipe, lavapipe) must find.
///   Width   LP_NATIVE_VECTOR_WIDTH: 256 bits unless the user chose 128. Stored images were made with 256. With any
///           other width Mesa 22.3 reads uninitialised memory as soon as a depth buffer is bound: its loads of depth
///           know 4 and 8 lanes (lp_build_depth_stencil_load_swizzled).
///   Filters GALLIVM_PERF: no_aos_sampling, besides what the user chose. Otherwise textures of 8-bit numbers are
///           filtered with weights of 8 bits (lp_bld_sample_aos.c): no better than the texels, and 26.1 rounds these
///           weights in another way than 22.3 to 25.0. In floating point all of them give the same bits. The key of
///           Mesa's cache has this variable.
///   Cache   a directory of its own for every width but 256. Mesa 22.3 keeps compiled shaders on disk under a key that
///           leaves the width out: code for 256 bits, run by a process of 128, writes past the end of its buffers.
///   Thread  any; applyMesaEnvironment() before the first driver is loaded, because Mesa reads the variables then.
///   Removal of the cache's directory when Mesa's key has the width (lp_disk_cache_create).
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace filament_core::backend {

struct EnvironmentChange {
    std::string name, value;
};

struct MesaEnvironment {
    std::vector<EnvironmentChange> changes;
    std::string note; ///< about a value of the user's that was not kept; empty: none
};

/// Pure. `lookup` is std::getenv or a stand-in.
MesaEnvironment mesaEnvironment(std::function<const char*(const char*)> const& lookup);

/// Makes the changes, once a process, and logs the note.
void applyMesaEnvironment();

} // namespace filament_core::backend
