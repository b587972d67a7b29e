// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/VideoFile.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/program/ChildProcess.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace filament_core::view {
namespace {

constexpr auto kLookInterval = std::chrono::milliseconds(5);
constexpr size_t kLongestLog = size_t{ 1 } << 20, kLongestReason = 300;

constexpr std::array<std::string_view, 4> kVideoEndings{ ".mp4", ".mov", ".mkv", ".webm" };

bool isVideoEnding(std::string_view ending) { return std::ranges::find(kVideoEndings, ending) != kVideoEndings.end(); }

bool isInPath(std::string_view program) {
    const char* path = std::getenv("PATH");
    std::string_view folders = path ? path : "";
    while (!folders.empty()) {
        const size_t end = std::min(folders.find(':'), folders.size());
        const std::filesystem::path file = std::filesystem::path(folders.substr(0, end)) / program;
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0) return true;
        folders.remove_prefix(std::min(end + 1, folders.size()));
    }
    return false;
}

std::filesystem::path absoluteOf(std::filesystem::path const& file) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(file, error);
    return error ? file : whole;
}

/// The folder as it is, and the pattern in the name.
std::string patternText(std::filesystem::path const& pattern) {
    std::string text;
    for (const char c : absoluteOf(pattern).parent_path().string())
        text += c == '%' ? std::string("%%") : std::string(1, c);
    return text + "/" + pattern.filename().string();
}

/// What ffmpeg said last: its reason. One line that can be printed.
std::string lastLine(std::filesystem::path const& log) {
    const Result<std::string> text = assets::readText(log, kLongestLog);
    if (!text) return "it gave no reason";
    std::string_view rest = *text;
    while (!rest.empty() && (rest.back() == '\n' || rest.back() == '\r')) rest.remove_suffix(1);
    rest = rest.substr(rest.find_last_of("\r\n") + 1);
    std::string line(rest.substr(0, kLongestReason));
    std::ranges::replace_if(
            line, [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
    return line.empty() ? "it gave no reason" : line;
}

/// Files beside the video that end with this object.
struct PartialFiles {
    std::filesystem::path video, log;

    explicit PartialFiles(std::filesystem::path const& file) {
        const std::filesystem::path whole = absoluteOf(file);
        const std::string stem = fmt::format(".{}.{}", whole.stem().string(), getpid());
        video = whole.parent_path() / (stem + ".partial" + whole.extension().string());
        log = whole.parent_path() / (stem + ".ffmpeg.log");
    }
    PartialFiles(PartialFiles const&) = delete;
    PartialFiles& operator=(PartialFiles const&) = delete;
    ~PartialFiles() {
        std::error_code ignored;
        std::filesystem::remove(video, ignored);
        std::filesystem::remove(log, ignored);
    }
};

Result<void> runFfmpeg(std::vector<std::string> const& words, std::filesystem::path const& log,
                       std::filesystem::path const& file, std::function<bool()> const& isCancelled) {
    Result<tools::ChildProcess> child = tools::ChildProcess::start({ .words = words, .log = log });
    if (!child) return child.error();
    for (;;) {
        if (const std::optional<tools::ChildEnd> end = child->poll()) {
            if (end->exitStatus == 0 && end->signal == 0) return {};
            return fail(ErrorCode::Unreadable, "'{}': ffmpeg ended with {}: {}", file.string(), end->text(),
                        lastLine(log));
        }
        if (isCancelled && isCancelled()) return fail(ErrorCode::Cancelled, "'{}': cancelled", file.string());
        std::this_thread::sleep_for(kLookInterval);
    }
}

} // namespace

Result<void> checkVideo(std::filesystem::path const& file) {
    if (!isVideoEnding(file.extension().string()))
        return fail(ErrorCode::InvalidArgument, "'{}': a video ends with .mp4, .mov, .mkv or .webm", file.string());
    if (isInPath("ffmpeg")) return {};
    return fail(ErrorCode::NotFound,
                "'{}': a video needs the ffmpeg command, which is not in PATH; install it (apt-get install ffmpeg) or "
                "record frames",
                file.string());
}

std::vector<std::string> videoWords(VideoRequest const& request, std::filesystem::path const& output) {
    const std::string rate = fmt::format("{}", request.framesPerSecond);
    return { "ffmpeg",
             "-hide_banner",
             "-nostdin",
             "-loglevel",
             "error",
             "-y",
             "-f",
             "image2",
             "-framerate",
             rate,
             "-start_number",
             "0",
             "-i",
             patternText(request.pattern),
             "-frames:v",
             fmt::format("{}", request.frames),
             "-vf",
             "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
             "-colorspace",
             "bt709",
             "-color_primaries",
             "bt709",
             "-color_trc",
             "iec61966-2-1",
             "-color_range",
             "tv",
             absoluteOf(output).string() };
}

Result<void> makeVideo(VideoRequest const& request, std::function<bool()> const& isCancelled) {
    if (Result<void> good = checkVideo(request.file); !good) return good;
    const PartialFiles partial(request.file);
    const std::vector<std::string> words = videoWords(request, partial.video);
    if (Result<void> done = runFfmpeg(words, partial.log, request.file, isCancelled); !done) return done;
    std::error_code error;
    std::filesystem::rename(partial.video, request.file, error);
    if (!error) return {};
    return fail(ErrorCode::Unreadable, "'{}': ffmpeg wrote no video that can be kept: {}", request.file.string(),
                error.message());
}

} // namespace filament_core::view
