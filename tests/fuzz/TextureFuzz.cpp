// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/TextureFuzzBody.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    filament_core::assets::test::fuzzTexture(bytes);
    filament_core::assets::test::fuzzBasis(bytes);
    return 0;
}
