// SPDX-License-Identifier: Apache-2.0
/// removeLeftoverFiles: deletes the temporary files of writers that were killed.
///   A file is left over if its process is gone and nobody has written to it for a minute, or for an hour whatever the
///   process (it may be on another machine).
///   In      writerOf(name): the process id in the name of a temporary file, 0 for all other files.
///   Thread  any. Memory: none of ours; std::filesystem ends the process where its iterators find none.
///   Fails   never: what cannot be read or deleted stays.
#pragma once

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <string_view>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace filament_core {

/// Returns the number of deleted files.
template <class WriterOf>
size_t removeLeftoverFiles(const char* folder, WriterOf&& writerOf) {
    constexpr time_t kMinute = 60, kHour = 3600;
    DIR* const entries = ::opendir(folder);
    if (!entries) return 0;
    size_t removed = 0;
    while (const dirent* entry = ::readdir(entries)) {
        const pid_t writer = writerOf(std::string_view(entry->d_name));
        struct stat status {};
        const int directory = ::dirfd(entries);
        if (writer <= 0 || ::fstatat(directory, entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
        if (!S_ISREG(status.st_mode)) continue;
        const time_t age = ::time(nullptr) - status.st_mtime;
        const bool isGone = ::kill(writer, 0) != 0 && errno == ESRCH;
        if (age <= kHour && (!isGone || age <= kMinute)) continue;
        if (::unlinkat(directory, entry->d_name, 0) == 0) ++removed;
    }
    ::closedir(entries);
    return removed;
}

} // namespace filament_core
