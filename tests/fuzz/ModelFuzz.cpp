// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/engine/gltf/ModelFuzzBody.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace filament_core;
    static Engine engine = *Engine::create({ .backend = Backend::Null, .workers = 0 });
    static Renderer renderer(engine);
    test::fuzzModel(engine, renderer, std::as_bytes(std::span(data, size)));
    return 0;
}
