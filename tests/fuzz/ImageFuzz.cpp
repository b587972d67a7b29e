// SPDX-License-Identifier: Apache-2.0
// Every decoder of images; the first bytes decide, so that a corpus of all formats serves all of them.
#include "tests/filament_core/assets/environment/EnvironmentFuzzBody.h"
#include "tests/filament_core/assets/image/ImageFuzzBody.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    namespace test = filament_core::assets::test;
    const auto bytes = std::as_bytes(std::span(data, size));
    test::fuzzPicture(bytes);
    if (filament_core::assets::isBakedEnvironment(bytes))
        test::fuzzEnvironment(bytes);
    else if (filament_core::assets::isKtx2(bytes))
        test::fuzzEnvironmentPackage(bytes);
    else if (!test::fuzzHdrImage(bytes))
        test::fuzzImage(bytes);
    return 0;
}
