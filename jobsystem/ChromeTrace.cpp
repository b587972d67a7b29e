// SPDX-License-Identifier: Apache-2.0
// Writes the JSON of JobTrace.h: one event per line, so that text tools can compare and search it.
#include "jobsystem/JobTrace.h"

#include "base/Result.h"
#include "base/Utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <ostream>
#include <string_view>

namespace filament_core::jobs {
namespace {

constexpr int kProcess = 1; // the file has only one; its number is arbitrary

// Writes a JSON string; bytes that are not UTF-8 become the replacement character.
std::string jsonString(std::string_view text) {
    std::string json = "\"";
    while (!text.empty()) {
        const size_t length = utf8Length(text);
        const auto first = static_cast<unsigned char>(text[0]);
        if (length == 0) {
            json += "\\ufffd";
        } else if (first == '"' || first == '\\') {
            json += { '\\', text[0] };
        } else if (first < 0x20) {
            fmt::format_to(std::back_inserter(json), "\\u{:04x}", first);
        } else {
            json += text.substr(0, length);
        }
        text.remove_prefix(std::max<size_t>(length, 1));
    }
    return json + '"';
}

// Exact: a double would round timestamps on a machine that has been up for months.
std::string microseconds(int64_t nanoseconds) {
    return fmt::format("{}.{:03}", nanoseconds / 1000, nanoseconds % 1000);
}

std::string nameLines(TraceTrack const& track, size_t thread) {
    return fmt::format(R"({{"ph":"M","pid":{0},"tid":{1},"name":"thread_name","args":{{"name":{2}}}}})"
                       ",\n"
                       R"({{"ph":"M","pid":{0},"tid":{1},"name":"thread_sort_index","args":{{"sort_index":{1}}}}})",
                       kProcess, thread, jsonString(track.name));
}

std::string eventLine(TraceEvent const& event, size_t thread, int64_t origin) {
    const bool isSpan = event.kind == TraceEvent::Kind::Span;
    std::string arguments;
    if (!isSpan) arguments = fmt::format(R"("stolen":{})", event.kind == TraceEvent::Kind::StolenJob);
    if (isSpan && event.frame >= 0) arguments = fmt::format(R"("frame":{})", event.frame);
    return fmt::format(R"({{"ph":"X","pid":{},"tid":{},"cat":"{}","name":{},"ts":{},"dur":{},"args":{{{}}}}})",
                       kProcess, thread, isSpan ? "span" : "job", jsonString(event.name),
                       microseconds(event.begin - origin), microseconds(event.end - event.begin), arguments);
}

int64_t firstBegin(std::vector<TraceTrack> const& tracks) {
    int64_t first = std::numeric_limits<int64_t>::max();
    for (TraceTrack const& track : tracks) {
        for (TraceEvent const& event : track.events) first = std::min(first, event.begin);
    }
    return first;
}

} // namespace

void writeChromeTrace(std::vector<TraceTrack> const& tracks, std::ostream& out) {
    const int64_t origin = firstBegin(tracks);
    uint64_t dropped = 0;
    for (TraceTrack const& track : tracks) dropped += track.dropped;
    out << fmt::format(R"({{"displayTimeUnit":"ns","otherData":{{"droppedEvents":{}}},"traceEvents":[)", dropped);
    const char* separator = "\n";
    for (size_t i = 0; i < tracks.size(); ++i) {
        out << separator << nameLines(tracks[i], i + 1);
        separator = ",\n";
        for (TraceEvent const& event : tracks[i].events) out << separator << eventLine(event, i + 1, origin);
    }
    out << "\n]}\n";
}

Result<void> writeChromeTrace(std::vector<TraceTrack> const& tracks, std::filesystem::path const& file) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    if (out) writeChromeTrace(tracks, out);
    out.close();
    if (out) return {};
    return fail(ErrorCode::Unreadable, "cannot write the job trace '{}': {}; choose a file that can be written",
                file.string(), errno != 0 ? std::strerror(errno) : "writing stopped");
}

} // namespace filament_core::jobs
