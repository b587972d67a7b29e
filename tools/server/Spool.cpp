// SPDX-License-Identifier: Apache-2.0
#include "tools/server/Spool.h"

#include "toolkit/json/JsonFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

namespace filament_core::server {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostNameLetters = 64;

Error systemError(fs::path const& path, std::string_view what) {
    return { ErrorCode::Unreadable, fmt::format("{}: {}: {}", path.string(), what, std::strerror(errno)) };
}

/// The parts of a file name between dots, without the ending.
std::vector<std::string> partsOf(fs::path const& file) {
    std::vector<std::string> parts(1);
    for (const char letter : file.stem().string()) {
        if (letter == '.')
            parts.emplace_back();
        else
            parts.back() += letter;
    }
    return parts;
}

uint32_t numberOf(std::string const& text) { return static_cast<uint32_t>(std::strtoul(text.c_str(), nullptr, 10)); }

/// Sorted; files that other processes move away meanwhile are left out.
std::vector<fs::path> filesOf(fs::path const& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error))
        files.push_back(each->path());
    std::ranges::sort(files);
    return files;
}

std::optional<fs::path> fileOf(fs::path const& folder, std::string const& name) {
    for (fs::path const& file : filesOf(folder))
        if (partsOf(file)[0] == name) return file;
    return std::nullopt;
}

Result<std::string> textOf(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(in), {});
    if (!in && !in.eof()) return systemError(file, "cannot be read");
    return text;
}

} // namespace

Spool::Spool(fs::path const& folder, uint32_t mostQueued)
        : mNew(folder / "new"), mQueued(folder / "queued"), mRunning(folder / "running"), mDone(folder / "done"),
          mMostQueued(mostQueued) {}

Result<Spool> Spool::open(fs::path const& folder, uint32_t mostQueued) {
    Spool spool(folder, mostQueued);
    for (fs::path const& each : { spool.mNew, spool.mQueued, spool.mRunning, spool.mDone }) {
        std::error_code error;
        fs::create_directories(each, error);
        if (error) return Error{ ErrorCode::Unreadable, fmt::format("{}: {}", each.string(), error.message()) };
    }
    return spool;
}

bool Spool::isName(std::string_view name) {
    const auto isAllowed = [](char letter) {
        return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
               (letter >= 'A' && letter <= 'Z') || letter == '-' || letter == '_';
    };
    return !name.empty() && name.size() <= kMostNameLetters && std::ranges::all_of(name, isAllowed);
}

std::string Spool::makeName() {
    static std::atomic<uint32_t> count{ 0 };
    static const uint32_t process = std::random_device{}();
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return fmt::format("{:016x}-{:04x}-{:08x}", std::chrono::duration_cast<std::chrono::microseconds>(now).count(),
                       count++ & 0xffffu, process);
}

Result<void> Spool::write(fs::path const& to, std::span<const std::byte> bytes) const {
    const fs::path begun = mNew / fmt::format("{}.{}", to.filename().string(), makeName());
    const int file = ::open(begun.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (file < 0) return systemError(begun, "cannot be written");
    for (size_t at = 0; at < bytes.size();) {
        const ssize_t written = ::write(file, bytes.data() + at, bytes.size() - at);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            const Error error = systemError(begun, "cannot be written");
            ::close(file);
            ::unlink(begun.c_str());
            return error;
        }
        at += static_cast<size_t>(written);
    }
    const bool isOnDisk = ::fdatasync(file) == 0;
    ::close(file);
    if (isOnDisk && ::rename(begun.c_str(), to.c_str()) == 0) return {};
    const Error error = systemError(to, "cannot be written");
    ::unlink(begun.c_str());
    return error;
}

Result<Accepted> Spool::accept(std::string const& name, std::string_view request) {
    if (!isName(name))
        return Error{ ErrorCode::InvalidArgument,
                      fmt::format("the id '{}' is no name: letters, digits, - and _, at most {}", name,
                                  kMostNameLetters) };
    if (state(name) != JobState::Unknown) return Accepted::Known;
    if (queuedCount() >= mMostQueued) return Accepted::Full;
    if (Result<void> done = write(mQueued / (name + ".0.json"), std::as_bytes(std::span(request))); !done)
        return done.error();
    return Accepted::New;
}

JobState Spool::state(std::string const& name) const {
    // In the order of a job's way: one that moves on meanwhile is seen where it goes.
    if (fileOf(mQueued, name)) return JobState::Queued;
    if (fileOf(mRunning, name)) return JobState::Running;
    if (fs::exists(mDone / (name + ".json"))) return JobState::Done;
    return fileOf(mQueued, name) ? JobState::Queued : JobState::Unknown; // back from a process that ended
}

Result<std::optional<ClaimedJob>> Spool::claim() {
    for (fs::path const& queued : filesOf(mQueued)) {
        const std::vector<std::string> parts = partsOf(queued);
        if (parts.size() != 2) continue; // not one of ours
        ClaimedJob job{ .name = parts[0],
                        .request = {},
                        .tries = numberOf(parts[1]),
                        .file = mRunning / fmt::format("{}.{}.{}.json", parts[0], parts[1], ::getpid()) };
        if (::rename(queued.c_str(), job.file.c_str()) != 0) {
            if (errno == ENOENT) continue; // another process was first
            return systemError(queued, "cannot be claimed");
        }
        Result<std::string> text = textOf(job.file);
        if (!text) return text.error();
        job.request = std::move(*text);
        return std::optional(std::move(job));
    }
    return std::optional<ClaimedJob>{};
}

fs::path Spool::imageDraft(ClaimedJob const& job) const { return mNew / (job.name + ".image"); }

/// On the disk before it has its name.
Result<void> Spool::putImage(ClaimedJob const& job) const {
    const fs::path draft = imageDraft(job), to = imageFile(job.name);
    const int file = ::open(draft.c_str(), O_RDWR | O_CLOEXEC);
    const bool isOnDisk = file >= 0 && ::fdatasync(file) == 0;
    if (file >= 0) ::close(file);
    if (isOnDisk && ::rename(draft.c_str(), to.c_str()) == 0) return {};
    const Error error = systemError(to, "cannot be written");
    ::unlink(draft.c_str());
    return error;
}

Result<void> Spool::finish(ClaimedJob const& job, JobOutcome const& outcome) {
    // The image first: where there is an outcome, there is its image.
    if (outcome.error.empty()) {
        if (Result<void> done = putImage(job); !done) return done;
    }
    const tools::Json json = { { "status", outcome.status },
                               { "error", outcome.error },
                               { "contentType", outcome.contentType },
                               { "queuedSeconds", outcome.queuedSeconds },
                               { "renderSeconds", outcome.renderSeconds } };
    const std::string text = tools::jsonText(json);
    if (Result<void> done = write(mDone / (job.name + ".json"), std::as_bytes(std::span(text))); !done) return done;
    ::unlink(job.file.c_str());
    return {};
}

std::optional<JobOutcome> Spool::outcome(std::string const& name) const {
    const Result<tools::Json> json = tools::readJson(mDone / (name + ".json"));
    if (!json || !json->is_object()) return std::nullopt;
    return JobOutcome{ .status = json->value("status", 500),
                       .error = json->value("error", ""),
                       .contentType = json->value("contentType", ""),
                       .queuedSeconds = json->value("queuedSeconds", 0.0),
                       .renderSeconds = json->value("renderSeconds", 0.0) };
}

fs::path Spool::imageFile(std::string const& name) const { return mDone / (name + ".image"); }

Result<void> Spool::release(long process, bool isToBlame, uint32_t mostTries, std::string const& reason, int status) {
    for (fs::path const& file : filesOf(mRunning)) {
        const std::vector<std::string> parts = partsOf(file);
        if (parts.size() != 3 || (process != 0 && numberOf(parts[2]) != process)) continue;
        if (fs::exists(mDone / (parts[0] + ".json"))) { // it ended between the outcome and here
            ::unlink(file.c_str());
            continue;
        }
        const uint32_t tries = numberOf(parts[1]) + (isToBlame ? 1 : 0);
        const ClaimedJob job{ .name = parts[0], .request = {}, .tries = tries, .file = file };
        ::unlink(imageDraft(job).c_str()); // a part of it
        if (tries >= mostTries) {
            if (Result<void> done = finish(job, { .status = status, .error = reason, .contentType = {} }); !done)
                return done;
            continue;
        }
        const fs::path back = mQueued / fmt::format("{}.{}.json", parts[0], tries);
        if (::rename(file.c_str(), back.c_str()) != 0) return systemError(file, "cannot go back to the queue");
    }
    return {};
}

std::string Spool::runningOf(long process) const {
    for (fs::path const& file : filesOf(mRunning)) {
        const std::vector<std::string> parts = partsOf(file);
        if (parts.size() == 3 && numberOf(parts[2]) == process) return parts[0];
    }
    return {};
}

Result<void> Spool::releaseAll() {
    for (fs::path const& file : filesOf(mNew)) ::unlink(file.c_str()); // was never accepted
    return release(0, false, ~0u, {}, 500);
}

bool Spool::remove(std::string const& name) {
    if (const std::optional<fs::path> queued = fileOf(mQueued, name); queued && ::unlink(queued->c_str()) == 0)
        return true;
    const bool wasDone = ::unlink((mDone / (name + ".json")).c_str()) == 0;
    ::unlink(imageFile(name).c_str());
    return wasDone;
}

void Spool::keepNewest(size_t outcomes) {
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (fs::path const& file : filesOf(mDone)) {
        std::error_code error;
        const fs::file_time_type time = fs::last_write_time(file, error);
        if (!error && file.extension() == ".json") files.emplace_back(time, file);
    }
    if (files.size() <= outcomes) return;
    std::ranges::sort(files);
    files.resize(files.size() - outcomes);
    for (auto const& [time, file] : files) remove(file.stem().string());
}

uint32_t Spool::queuedCount() const { return static_cast<uint32_t>(filesOf(mQueued).size()); }
uint32_t Spool::runningCount() const { return static_cast<uint32_t>(filesOf(mRunning).size()); }

} // namespace filament_core::server
