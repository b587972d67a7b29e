// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/TraceFuzzBody.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::backend::fuzzTraceOnce({ data, size });
    return 0;
}
