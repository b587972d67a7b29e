// SPDX-License-Identifier: Apache-2.0
#include "tools/server/Options.h"

#include "toolkit/program/CommandLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace filament_core::server {
namespace {

constexpr const char* kDescription = "Draws scene files for programs that send them, over HTTP or over standard input.";
constexpr const char* kFooter = R"(Without --mcp it listens for HTTP: docs/server.md, or /openapi.json of the server.
  curl -d '{"scene": {"points": [{"at": [0, 2, 0]}]}, "size": [320, 180]}' http://127.0.0.1:8080/v1/render -o picture.png
Every program that reaches the port can draw. It is that of this machine alone unless --address says otherwise.
Accepted jobs are in --spool: a server that starts with the same folder goes on with them.)";

/// As many workers as cores, each of which draws with one.
uint32_t coreCount() { return std::max(1u, std::thread::hardware_concurrency()); }

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    Options options{ .workers = coreCount() };
    bool isMcp = false, isWorker = false;
    RequestLimits& limits = options.service.limits;
    int port = options.http.port;
    uint32_t megabytes = 8, megapixels = 16;
    tools::CommandLine line(kDescription, "filament-server");
    line.option("--spool", options.spool, "folder of the queue and of outcomes");
    line.option("--assets", limits.assets, "where \"asset:\" paths of scenes begin");
    line.option("--scenes", limits.scenes, "folder of scenes that clients name (sceneFile)");
    line.option("--address", options.http.address, "to listen on").showsDefault();
    line.option("--port", port, "to listen on; 0: any, which is printed").showsDefault().inRange(0, 65535);
    line.option("--workers", options.workers, "processes that draw (one per core)").inRange(1, 1024);
    line.option("--queue", options.mostQueued, "jobs that wait; more are answered with 503")
            .showsDefault()
            .inRange(1, 100'000);
    line.option("--limit", options.mostSeconds, "seconds that drawing a job may take")
            .showsDefault()
            .inRange(0.1, 86400.0);
    line.option("--wait", options.service.waitSeconds, "seconds until /v1/render answers with 504")
            .showsDefault()
            .inRange(0.1, 86400.0);
    line.option("--keep", options.service.keptOutcomes, "outcomes that are kept").showsDefault().inRange(1, 10'000'000);
    line.option("--threads", options.http.threads, "connections that are served at once")
            .showsDefault()
            .inRange(1, 4096);
    line.option("--request-megabytes", megabytes, "largest request").showsDefault().inRange(1, 1024);
    line.option("--megapixels", megapixels, "largest picture").showsDefault().inRange(1, 256);
    line.flag("--mcp", isMcp, "tools for agents over standard input and output (Model Context Protocol)");
    line.flag("--worker", isWorker, "draws jobs of --spool until its parent ends: what the server starts");
    line.footer(kFooter);
    const Result<bool> parsed = line.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>{};
    if (isMcp && isWorker) return Error{ ErrorCode::InvalidArgument, "command line: one of --mcp and --worker" };
    options.mode = isWorker ? Mode::Worker : isMcp ? Mode::Mcp : Mode::Http;
    options.http.port = port;
    options.http.mostBytes = size_t{ megabytes } << 20;
    limits.mostPixels = megapixels << 20;
    options.workerCommand = { "/proc/self/exe",       "--worker",     "--spool",
                              options.spool.string(), "--megapixels", fmt::to_string(megapixels) };
    for (auto const& [name, folder] : { std::pair("--assets", limits.assets), std::pair("--scenes", limits.scenes) }) {
        if (!folder.empty()) options.workerCommand.insert(options.workerCommand.end(), { name, folder.string() });
    }
    return std::optional(std::move(options));
}

} // namespace filament_core::server
