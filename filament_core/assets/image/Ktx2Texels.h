// SPDX-License-Identifier: Apache-2.0
/// arrangeKtx2: applies what the metadata of a file say about its decoded texels: the order of channels (KTXswizzle)
/// and of rows and columns (KTXorientation). KTX 2.0 Specification, 5.2 and 5.3.
///   Thread  any; pure. Does nothing for files without metadata.
#pragma once

#include "filament_core/assets/image/Image.h"
#include "filament_core/assets/image/Ktx2File.h"

#include <span>

namespace filament_core::assets {

/// Whether it would change anything.
bool isArranged(Ktx2File const& file);

/// `texels`: those of `level` of the image, all layers. Four channels of 8, 16 or 32 bits.
void arrangeKtx2(Ktx2File const& file, Image const& image, uint32_t level, std::span<std::byte> texels);

} // namespace filament_core::assets
