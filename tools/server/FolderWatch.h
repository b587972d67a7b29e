// SPDX-License-Identifier: Apache-2.0
/// FolderWatch: waits until a file is moved into a folder, by inotify, without work meanwhile.
///   Thread  one.   Fails: without inotify it waits for short times instead.
#pragma once

#include <chrono>
#include <filesystem>

namespace filament_core::server {

class FolderWatch {
public:
    explicit FolderWatch(std::filesystem::path const& folder);
    ~FolderWatch();
    FolderWatch(FolderWatch const&) = delete;
    FolderWatch& operator=(FolderWatch const&) = delete;

    /// Until a file has come since the last call, or that time is over.
    void wait(std::chrono::milliseconds most);

private:
    int mNotify = -1;
};

} // namespace filament_core::server
