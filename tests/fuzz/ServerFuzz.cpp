// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/ServerFuzzBody.h"

#include <filesystem>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace filament_core;
    static const server::Spool spool = *server::Spool::open(std::filesystem::temp_directory_path() / "server-fuzz", 1);
    static const server::Workers workers(spool, {});
    static server::RenderService service(spool, workers, {});
    fuzzServerOnce(service, { data, size });
    return 0;
}
