// SPDX-License-Identifier: Apache-2.0
/// mirrorOf: which sides of an AVIF image are swapped: 0 top and bottom, 1 left and right. libavif 1.0 renamed it.
#pragma once

#include <avif/avif.h>

namespace filament_core::assets {

template <class Mirror>
auto& mirrorOf(Mirror& mirror) {
    if constexpr (requires { mirror.axis; })
        return mirror.axis;
    else
        return mirror.mode;
}

} // namespace filament_core::assets
