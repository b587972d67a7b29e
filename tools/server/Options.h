// SPDX-License-Identifier: Apache-2.0
/// Options of filament-server.
#pragma once

#include "tools/server/HttpServer.h"

#include <filesystem>
#include <optional>

namespace filament_core::server {

enum class Mode : uint8_t { Http, Mcp, Worker };

struct Options {
    Mode mode = Mode::Http;
    std::filesystem::path spool = "server-spool";
    ServiceSettings service{};
    HttpSettings http{};
    uint32_t workers = 1, mostQueued = 256;
    double mostSeconds = 60;
    std::vector<std::string> workerCommand{}; ///< this program with what workers need of the options
};

/// Nothing after the help text.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::server
