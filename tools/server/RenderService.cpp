// SPDX-License-Identifier: Apache-2.0
#include "tools/server/RenderService.h"

#include "base/Log.h"
#include "toolkit/json/JsonFile.h"
#include "tools/server/FolderWatch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>

namespace filament_core::server {
namespace {

using tools::Json;

constexpr uint32_t kTidyEvery = 64; // accepted jobs

std::string bytesOf(std::filesystem::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return { std::istreambuf_iterator<char>(in), {} };
}

uint64_t residentBytesOfThis() {
    std::ifstream file("/proc/self/statm");
    uint64_t pages = 0, resident = 0;
    file >> pages >> resident;
    return resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

const char* wordOf(JobState state) {
    switch (state) {
    case JobState::Queued:
        return "queued";
    case JobState::Running:
        return "running";
    case JobState::Done:
        return "done";
    default:
        return "unknown";
    }
}

} // namespace

Answer errorAnswer(int status, std::string_view message) {
    return { .status = status, .body = tools::jsonText(Json{ { "error", message } }), .id = {} };
}

RenderService::RenderService(Spool spool, Workers const& workers, ServiceSettings settings)
        : mSpool(std::move(spool)), mWorkers(workers), mSettings(std::move(settings)) {}

Answer RenderService::accept(std::string_view request, bool& isNamed) {
    if (mWorkers.isBroken()) return errorAnswer(500, "this machine cannot draw: see the server's log");
    const Result<RenderRequest> parsed = parseRequest(request, mSettings.limits);
    if (!parsed) return errorAnswer(400, withoutFolders(parsed.error().message, mSettings.limits));
    isNamed = !parsed->id.empty();
    const std::string id = isNamed ? parsed->id : Spool::makeName();
    if (++mAccepted % kTidyEvery == 0) mSpool.keepNewest(mSettings.keptOutcomes);
    const Result<Accepted> accepted = mSpool.accept(id, request);
    if (!accepted && accepted.error().code == ErrorCode::InvalidArgument)
        return errorAnswer(400, accepted.error().message);
    if (!accepted) {
        log(Severity::Error, "{}", accepted.error().message);
        return errorAnswer(507, "the server cannot write the job: is its disk full?");
    }
    if (*accepted == Accepted::Full) return errorAnswer(503, "the queue is full; try again later");
    return { .status = 202, .body = {}, .id = id };
}

Answer RenderService::submit(std::string_view request) {
    bool isNamed = false;
    const Answer accepted = accept(request, isNamed);
    if (accepted.id.empty()) return accepted;
    Answer answer = job(accepted.id);
    if (answer.status == 200) answer.status = 202;
    return answer;
}

Answer RenderService::render(std::string_view request) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                         std::chrono::duration<double>(mSettings.waitSeconds));
    FolderWatch watch(mSpool.doneFolder()); // before the job is there, so that its end is not missed
    bool isNamed = false;
    const Answer accepted = accept(request, isNamed);
    if (accepted.id.empty()) return accepted;
    for (;;) {
        if (const std::optional<JobOutcome> outcome = mSpool.outcome(accepted.id)) {
            mMetrics.rendered(outcome->queuedSeconds, outcome->renderSeconds);
            Answer answer = answerOf(accepted.id, *outcome);
            if (!isNamed) mSpool.remove(accepted.id);
            return answer;
        }
        if (Clock::now() >= end) {
            Answer late = errorAnswer(504, fmt::format("no image within {} s; the job goes on", mSettings.waitSeconds));
            late.id = accepted.id;
            return late;
        }
        watch.wait(std::chrono::milliseconds(250));
    }
}

Answer RenderService::answerOf(std::string const& id, JobOutcome const& outcome) const {
    if (!outcome.error.empty()) {
        Answer answer = errorAnswer(outcome.status, outcome.error);
        answer.id = id;
        return answer;
    }
    return { .status = 200, .contentType = outcome.contentType, .body = bytesOf(mSpool.imageFile(id)), .id = id };
}

Answer RenderService::job(std::string const& id) const {
    const JobState state = Spool::isName(id) ? mSpool.state(id) : JobState::Unknown;
    if (state == JobState::Unknown) return errorAnswer(404, "there is no such job");
    Json json = { { "id", id }, { "status", wordOf(state) } };
    if (const std::optional<JobOutcome> outcome = mSpool.outcome(id)) {
        json["status"] = outcome->error.empty() ? "done" : "failed";
        json["queuedSeconds"] = outcome->queuedSeconds;
        json["renderSeconds"] = outcome->renderSeconds;
        if (!outcome->error.empty()) json["error"] = outcome->error;
        if (outcome->error.empty()) json["contentType"] = outcome->contentType;
    }
    return { .status = 200, .body = tools::jsonText(json), .id = id };
}

Answer RenderService::image(std::string const& id) const {
    const std::optional<JobOutcome> outcome = Spool::isName(id) ? mSpool.outcome(id) : std::nullopt;
    if (outcome) return answerOf(id, *outcome);
    const bool isKnown = Spool::isName(id) && mSpool.state(id) != JobState::Unknown;
    return isKnown ? errorAnswer(409, "the job is not done yet") : errorAnswer(404, "there is no such job");
}

Answer RenderService::remove(std::string const& id) {
    if (Spool::isName(id) && mSpool.remove(id)) return { .status = 200, .body = "{}\n", .id = id };
    const bool isKnown = Spool::isName(id) && mSpool.state(id) != JobState::Unknown;
    return isKnown ? errorAnswer(409, "a worker draws the job") : errorAnswer(404, "there is no such job");
}

Answer RenderService::check(std::string_view request) const {
    const Result<RenderRequest> parsed = parseRequest(request, mSettings.limits);
    return parsed ? Answer{ .status = 200, .body = "{\"valid\": true}\n", .id = {} }
                  : errorAnswer(400, withoutFolders(parsed.error().message, mSettings.limits));
}

ServerState RenderService::state() const {
    return { .queued = mSpool.queuedCount(),
             .running = mSpool.runningCount(),
             .workers = mWorkers.count(),
             .restarts = mWorkers.restarts(),
             .serverBytes = residentBytesOfThis(),
             .workerBytes = mWorkers.residentBytes() };
}

} // namespace filament_core::server
