// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/CubeFuzzBody.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::fuzzCubeOnce({ data, size });
    return 0;
}
