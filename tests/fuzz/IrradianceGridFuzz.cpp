// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/IrradianceGridFuzzBody.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::fuzzIrradianceGridOnce({ data, size });
    return 0;
}
