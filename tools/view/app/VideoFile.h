// SPDX-License-Identifier: Apache-2.0
/// VideoFile: makes a video of numbered PNG frames with the ffmpeg command.
///   Words    are handed to ffmpeg without a shell, so names may have any characters; '%', which ffmpeg's patterns use,
///            is doubled.
///   Colour   frames are sRGB; the video is BT.709 in limited range, 4:2:0, and marked so. An odd side gets one more
///            column or row of black.
///   Out      the file, replaced as a whole when it is complete.
///   Thread   any.
///   Fails    one line: InvalidArgument (the ending), NotFound (no ffmpeg, and how to get it), Unreadable (what ffmpeg
///            said last), Cancelled.
#pragma once

#include "base/Result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace filament_core::view {

struct VideoRequest {
    std::filesystem::path file;    ///< .mp4, .mov, .mkv or .webm
    std::filesystem::path pattern; ///< of the frames, from frame 0: "frames/frame-%05d.png"; the folder as it is
    uint32_t frames = 0;
    double framesPerSecond = 30;
};

/// The ending is known and ffmpeg is in PATH: before frames are drawn in vain.
Result<void> checkVideo(std::filesystem::path const& file);
/// The command: program and arguments.
std::vector<std::string> videoWords(VideoRequest const& request, std::filesystem::path const& output);
/// Waits for ffmpeg, and polls `isCancelled` meanwhile.
Result<void> makeVideo(VideoRequest const& request, std::function<bool()> const& isCancelled = {});

} // namespace filament_core::view
