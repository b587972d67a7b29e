// SPDX-License-Identifier: Apache-2.0
#include "tools/server/FolderWatch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <thread>

namespace filament_core::server {

FolderWatch::FolderWatch(std::filesystem::path const& folder) : mNotify(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    if (mNotify < 0) return;
    if (::inotify_add_watch(mNotify, folder.c_str(), IN_MOVED_TO) >= 0) return;
    ::close(mNotify);
    mNotify = -1;
}

FolderWatch::~FolderWatch() {
    if (mNotify >= 0) ::close(mNotify);
}

void FolderWatch::wait(std::chrono::milliseconds most) {
    constexpr std::chrono::milliseconds kShort(10);
    if (mNotify < 0) {
        std::this_thread::sleep_for(std::min(most, kShort));
        return;
    }
    pollfd events{ .fd = mNotify, .events = POLLIN, .revents = 0 };
    ::poll(&events, 1, static_cast<int>(most.count()));
    std::array<char, 4096> read;
    while (::read(mNotify, read.data(), read.size()) > 0) {
    }
}

} // namespace filament_core::server
