// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/MeshFileFuzzBody.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::assets::fuzzMeshFileOnce({ data, size });
    return 0;
}
