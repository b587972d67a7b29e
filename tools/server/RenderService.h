// SPDX-License-Identifier: Apache-2.0
/// RenderService: what HTTP and MCP have in common: requests become jobs of the spool, and answers come back.
///   Checked   a request is parsed before it is accepted: a wrong one is answered at once, and hurts no worker.
///   Pressure  with a full queue nothing is accepted: 503, and the client may come back later.
///   Thread    any.
#pragma once

#include "tools/server/Metrics.h"
#include "tools/server/RenderRequest.h"
#include "tools/server/Spool.h"
#include "tools/server/Workers.h"

#include <string>
#include <string_view>

namespace filament_core::server {

struct ServiceSettings {
    RequestLimits limits{};
    double waitSeconds = 120; ///< of render(): for the queue and the drawing together
    uint32_t keptOutcomes = 1000;
};

/// Of HTTP.
struct Answer {
    int status = 200;
    std::string contentType = "application/json";
    std::string body;
    std::string id; ///< of the job; empty: none
};

class RenderService {
public:
    RenderService(Spool spool, Workers const& workers, ServiceSettings settings);

    Answer submit(std::string_view request);
    /// Submits, waits for the outcome and gives the image. A job without an id of the client is then forgotten.
    Answer render(std::string_view request);
    Answer job(std::string const& id) const;
    Answer image(std::string const& id) const;
    Answer remove(std::string const& id);
    /// Whether the request would be accepted, without drawing it.
    Answer check(std::string_view request) const;
    ServerState state() const;
    bool isHealthy() const { return !mWorkers.isBroken(); }

    Metrics& metrics() { return mMetrics; }

private:
    /// The id; or the error.
    Answer accept(std::string_view request, bool& isNamed);
    Answer answerOf(std::string const& id, JobOutcome const& outcome) const;

    Spool mSpool;
    Workers const& mWorkers;
    ServiceSettings mSettings;
    Metrics mMetrics;
    std::atomic<uint32_t> mAccepted{ 0 };
};

Answer errorAnswer(int status, std::string_view message);

} // namespace filament_core::server
