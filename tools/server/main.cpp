// SPDX-License-Identifier: Apache-2.0
// filament-server: draws scene files for programs that send them. docs/server.md
#include "toolkit/program/Program.h"
#include "tools/server/Mcp.h"
#include "tools/server/Options.h"
#include "tools/server/RenderWorker.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <thread>

namespace filament_core::server {
namespace {

/// One server for a spool, until this process ends.
Result<void> lockSpool(std::filesystem::path const& folder) {
    const std::filesystem::path file = folder / "lock";
    const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) == 0) return {};
    return Error{ ErrorCode::Unreadable,
                  fmt::format("{}: another server has this folder; give another --spool", folder.string()) };
}

int serveHttp(RenderService& service, Options const& options) {
    HttpServer server(service, options.http);
    const Result<int> port = server.bind();
    if (!port) return tools::failed(port.error());
    const tools::StopOnInterrupt stops;
    std::thread listener([&] { server.listen(); });
    std::printf("http://%s:%d\n", options.http.address.c_str(), *port);
    std::fflush(stdout);
    while (!tools::isInterrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server.stop();
    listener.join();
    return 0;
}

int run(Options const& options) {
    Result<Spool> spool = Spool::open(options.spool, options.mostQueued);
    if (!spool) return tools::failed(spool.error());
    if (options.mode == Mode::Worker) {
        const Result<void> done = RenderWorker(std::move(*spool), options.service.limits).run();
        return done ? 0 : tools::failed(done.error());
    }
    Result<void> done = lockSpool(options.spool);
    if (done) done = spool->releaseAll(); // of a server that ended
    if (!done) return tools::failed(done.error());
    Workers workers(*spool, { .command = options.workerCommand,
                              .logs = options.spool,
                              .count = options.workers,
                              .mostSeconds = options.mostSeconds });
    done = workers.start();
    if (!done) return tools::failed(done.error());
    RenderService service(*spool, workers, options.service);
    if (options.mode == Mode::Http) return serveHttp(service, options);
    serveMcp(service, std::cin, std::cout);
    return 0;
}

} // namespace
} // namespace filament_core::server

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-server", argc, argv, server::parseOptions, server::run);
}
