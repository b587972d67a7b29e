// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/RecentFilesFuzzBody.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::fuzzRecentFilesOnce({ data, size });
    return 0;
}
