// SPDX-License-Identifier: Apache-2.0
/// Metrics: what a server did, in the text format of Prometheus (Exposition Formats 0.0.4).
///   Thread  any.   Memory: fixed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace filament_core::server {

/// Gauges, read when they are wanted.
struct ServerState {
    uint32_t queued = 0, running = 0, workers = 0, restarts = 0;
    uint64_t serverBytes = 0, workerBytes = 0; ///< resident
};

class Metrics {
public:
    /// `route`: of the API, not the path. `seconds`: from the request to the answer.
    void answered(std::string const& route, int status, double seconds);
    void rendered(double queuedSeconds, double renderSeconds);
    std::string text(ServerState const& state) const;

private:
    static constexpr std::array<double, 12> kBounds{ 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60 };
    struct Histogram {
        std::array<uint64_t, kBounds.size() + 1> counts{}; ///< the last: more
        double sum = 0;
        void add(double seconds);
        std::string text(std::string const& name, std::string const& help) const;
    };
    mutable std::mutex mMutex;
    std::map<std::pair<std::string, int>, uint64_t> mAnswers;
    Histogram mSeconds, mQueued, mRendered;
};

} // namespace filament_core::server
