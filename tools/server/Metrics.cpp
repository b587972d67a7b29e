// SPDX-License-Identifier: Apache-2.0
#include "tools/server/Metrics.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::server {

void Metrics::Histogram::add(double seconds) {
    ++counts[static_cast<size_t>(std::ranges::lower_bound(kBounds, seconds) - kBounds.begin())];
    sum += seconds;
}

std::string Metrics::Histogram::text(std::string const& name, std::string const& help) const {
    std::string out = fmt::format("# HELP {0} {1}\n# TYPE {0} histogram\n", name, help);
    uint64_t below = 0;
    for (size_t i = 0; i < kBounds.size(); ++i) {
        below += counts[i];
        out += fmt::format("{}_bucket{{le=\"{}\"}} {}\n", name, kBounds[i], below);
    }
    below += counts.back();
    return out + fmt::format("{0}_bucket{{le=\"+Inf\"}} {1}\n{0}_sum {2}\n{0}_count {1}\n", name, below, sum);
}

void Metrics::answered(std::string const& route, int status, double seconds) {
    const std::lock_guard lock(mMutex);
    ++mAnswers[{ route, status }];
    mSeconds.add(seconds);
}

void Metrics::rendered(double queuedSeconds, double renderSeconds) {
    const std::lock_guard lock(mMutex);
    mQueued.add(queuedSeconds);
    mRendered.add(renderSeconds);
}

std::string Metrics::text(ServerState const& state) const {
    const std::lock_guard lock(mMutex);
    std::string out = "# HELP filament_requests_total Answered requests.\n# TYPE filament_requests_total counter\n";
    for (auto const& [key, count] : mAnswers)
        out += fmt::format("filament_requests_total{{route=\"{}\",code=\"{}\"}} {}\n", key.first, key.second, count);
    const auto gauge = [&](const char* name, const char* help, uint64_t value) {
        out += fmt::format("# HELP {0} {1}\n# TYPE {0} gauge\n{0} {2}\n", name, help, value);
    };
    gauge("filament_jobs_queued", "Accepted jobs that no worker has.", state.queued);
    gauge("filament_jobs_running", "Jobs that workers draw.", state.running);
    gauge("filament_workers", "Processes that draw.", state.workers);
    gauge("filament_worker_restarts", "Workers that ended and were replaced.", state.restarts);
    gauge("filament_resident_bytes", "Memory of the server.", state.serverBytes);
    gauge("filament_workers_resident_bytes", "Memory of its workers.", state.workerBytes);
    out += mSeconds.text("filament_request_seconds", "From a request to its answer.");
    out += mQueued.text("filament_queued_seconds", "From accepting a job to drawing it.");
    return out + mRendered.text("filament_render_seconds", "Drawing a job.");
}

} // namespace filament_core::server
