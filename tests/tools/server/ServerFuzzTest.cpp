// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/ServerFuzzBody.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

namespace filament_core {
namespace {

std::span<const uint8_t> bytesOf(std::string const& text) {
    return { reinterpret_cast<const uint8_t*>(text.data()), text.size() };
}

// Valid texts with bytes changed, dropped and doubled.
TEST(ServerFuzz, AnyBytesAreARequestOrAnErrorOfOneLine) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "server-fuzz-test";
    const server::Spool spool = *server::Spool::open(folder, 1);
    const server::Workers workers(spool, {});
    server::RenderService service(spool, workers, {});
    const std::array<std::string, 4> texts{
        R"({"id": "a", "scene": {"points": [{"at": [0, 1, 0], "candela": 5}]}, "set": {"camera.eye": [0, 1, 4]}, "size": [8, 8]})",
        R"({"sceneFile": "a.json", "api": "gles", "format": "exr"})",
        R"({"jsonrpc": "2.0", "id": 1, "method": "tools/call", "params": {"name": "check_scene", "arguments": {"scene": {}}}})",
        R"({"jsonrpc": "2.0", "id": "x", "method": "initialize", "params": {}})"
    };
    EXPECT_TRUE(fuzzServerOnce(service, bytesOf(texts[0])));
    std::minstd_rand numbers(5);
    uint32_t requests = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = texts[numbers() % texts.size()];
        for (uint32_t change = numbers() % 4 + 1; change > 0; --change) {
            const size_t at = numbers() % text.size();
            switch (numbers() % 4) {
            case 0:
                text[at] = static_cast<char>(numbers());
                break;
            case 1:
                text.erase(at, numbers() % 8);
                break;
            case 2:
                text.insert(at, text.substr(at, numbers() % 16));
                break;
            default:
                text[at] = R"({}[]",:0)"[numbers() % 8];
            }
            if (text.empty()) text = " ";
        }
        requests += fuzzServerOnce(service, bytesOf(text));
    }
    EXPECT_GT(requests, 5u);
    EXPECT_LT(requests, 2500u);
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace filament_core
