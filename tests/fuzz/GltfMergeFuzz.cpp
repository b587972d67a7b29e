// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/assets/gltf/GltfMergeFuzzBody.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::assets::test::fuzzGltfMerge(std::as_bytes(std::span(data, size)));
    return 0;
}
