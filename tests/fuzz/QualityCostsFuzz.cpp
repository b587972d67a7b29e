// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/QualityCostsFuzzBody.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::fuzzQualityCostsOnce({ data, size });
    return 0;
}
