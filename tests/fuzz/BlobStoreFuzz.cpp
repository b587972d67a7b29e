// SPDX-License-Identifier: Apache-2.0
#include "base/Log.h"
#include "tests/base/BlobStoreFuzzBody.h"

#include <cstddef>
#include <cstdint>

#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const std::filesystem::path file =
            std::filesystem::temp_directory_path() / fmt::format("blob-store-fuzz.{}", getpid());
    filament_core::setLogThreshold(filament_core::Severity::Error); // a damaged store is a warning
    filament_core::test::fuzzBlobStore(std::as_bytes(std::span(data, size)), file);
    return 0;
}
