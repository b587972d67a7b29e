// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/FilmFileFuzzBody.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::test::fuzzFilmFile(std::as_bytes(std::span(data, size)));
    return 0;
}
